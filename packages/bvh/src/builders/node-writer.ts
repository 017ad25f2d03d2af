import { copyBox, FAR, LEFT, LEFT_MAX, NODE_WORDS, PARENT, RESERVED, RIGHT } from '../layout';

/** A hierarchy's nodes. */
export interface Tree {
  /** 16 words a node. */
  readonly nodes: Float32Array<ArrayBuffer>;
  readonly nodeCount: number;
}

/** Writes nodes one after the other, parents before their children. */
export class NodeWriter {
  readonly nodes: Float32Array<ArrayBuffer>;
  readonly words: Uint32Array<ArrayBuffer>;
  count = 0;

  /**
   * @param capacity Maximum number of nodes.
   * @param buffer Memory to use; default: new memory.
   */
  constructor(capacity: number, buffer: ArrayBuffer = new ArrayBuffer(4 * capacity * NODE_WORDS)) {
    this.nodes = new Float32Array(buffer, 0, capacity * NODE_WORDS);
    this.words = new Uint32Array(this.nodes.buffer);
  }

  /** A new node whose reference belongs into word `slot`; 0: the root. */
  under(slot: number): number {
    const { words } = this;
    const node = this.count++;
    // The root's is in a word that its box will take.
    words[slot] = node;
    words[node * NODE_WORDS + PARENT] = slot >>> 4;
    words[node * NODE_WORDS + RESERVED] = 0;
    return node;
  }

  /** Sets a reference at word `slot`, and its box: six numbers from `at` on. */
  put(slot: number, reference: number, box: Float32Array, at: number): void {
    this.words[slot] = reference;
    copyBox(this.nodes, slot - LEFT + (slot & LEFT_MAX), LEFT_MAX, box, at);
  }

  /**
   * A tree of one leaf, or of none if there is no box. Both references point to the leaf, as they must be valid: no
   * ray reaches the box of a missing child.
   */
  single(reference: number, box?: Float32Array): void {
    const missing = new Float32Array(6).fill(FAR);
    this.under(0);
    this.put(LEFT, reference, box ?? missing, 0);
    this.put(RIGHT, reference, missing, 0);
  }

  finish(): Tree {
    const used = this.count * NODE_WORDS;
    // A copy, always: the memory may be the next build's.
    return { nodes: this.nodes.slice(0, used), nodeCount: this.count };
  }
}

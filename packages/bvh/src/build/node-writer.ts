import { FAR, LEFT, LEFT_MIN, NODE_WORDS, PARENT, RESERVED, RIGHT, RIGHT_MIN } from '../layout';

/** A hierarchy's nodes. */
export interface Tree {
  /** 16 words a node. */
  readonly nodes: Float32Array<ArrayBuffer>;
  readonly nodeCount: number;
}

/** Puts nodes down one after the other, parents before their children. */
export class NodeWriter {
  readonly nodes: Float32Array<ArrayBuffer>;
  readonly words: Uint32Array<ArrayBuffer>;
  count = 0;

  /**
   * @param capacity Most nodes there can be.
   * @param buffer Where to put them, if there is a buffer already.
   */
  constructor(capacity: number, buffer: ArrayBuffer = new ArrayBuffer(4 * capacity * NODE_WORDS)) {
    this.nodes = new Float32Array(buffer, 0, capacity * NODE_WORDS);
    this.words = new Uint32Array(this.nodes.buffer);
  }

  /** A new node under `parent`; −1 for the root. */
  add(parent: number): number {
    const node = this.count++;
    this.words[node * NODE_WORDS + PARENT] = parent < 0 ? 0 : parent;
    this.words[node * NODE_WORDS + RESERVED] = 0;
    return node;
  }

  /** Sets a child's box, six numbers from `at` on, and reference. */
  childBox(node: number, right: boolean, reference: number, box: Float32Array | Float64Array, at: number): void {
    const { nodes } = this;
    const base = node * NODE_WORDS;
    const min = base + (right ? RIGHT_MIN : LEFT_MIN), max = min + 4;
    nodes[min] = box[at] as number;
    nodes[min + 1] = box[at + 1] as number;
    nodes[min + 2] = box[at + 2] as number;
    nodes[max] = box[at + 3] as number;
    nodes[max + 1] = box[at + 4] as number;
    nodes[max + 2] = box[at + 5] as number;
    this.words[base + (right ? RIGHT : LEFT)] = reference;
  }

  /**
   * A tree of one leaf, or of none if there is no box. Both references name the leaf, as they must name something: the box
   * of a missing child is one that no ray reaches.
   */
  single(reference: number, box?: Float32Array): void {
    const root = this.add(-1), missing = new Float32Array(6).fill(FAR);
    this.childBox(root, false, reference, box ?? missing, 0);
    this.childBox(root, true, reference, missing, 0);
  }

  finish(): Tree {
    const used = this.count * NODE_WORDS;
    // A copy, always: the memory may be the next build's.
    return { nodes: this.nodes.slice(0, used), nodeCount: this.count };
  }
}

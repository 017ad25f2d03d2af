import { FAR, LEFT, LEFT_MAX, LEFT_MIN, NODE_WORDS, PARENT, RESERVED, RIGHT, RIGHT_MAX, RIGHT_MIN } from '../layout';

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

  /** Sets a child's box and reference. */
  child(node: number, right: boolean, reference: number, x0: number, y0: number, z0: number, x1: number, y1: number, z1: number): void {
    const { nodes } = this;
    const base = node * NODE_WORDS;
    const min = base + (right ? RIGHT_MIN : LEFT_MIN);
    const max = base + (right ? RIGHT_MAX : LEFT_MAX);
    nodes[min] = x0;
    nodes[min + 1] = y0;
    nodes[min + 2] = z0;
    nodes[max] = x1;
    nodes[max + 1] = y1;
    nodes[max + 2] = z1;
    this.words[base + (right ? RIGHT : LEFT)] = reference;
  }

  /**
   * A tree of one leaf, or of none if there is no box. Both references name the leaf, as they must name something: the box
   * of a missing child is one that no ray reaches.
   */
  single(reference: number, box: ArrayLike<number> | undefined): void {
    const root = this.add(-1);
    const corner = (i: number) => box?.[i] ?? FAR;
    this.child(root, false, reference, corner(0), corner(1), corner(2), corner(3), corner(4), corner(5));
    this.child(root, true, reference, FAR, FAR, FAR, FAR, FAR, FAR);
  }

  finish(): Tree {
    const used = this.count * NODE_WORDS;
    // A copy, always: the memory may be the next build's.
    return { nodes: this.nodes.slice(0, used), nodeCount: this.count };
  }
}

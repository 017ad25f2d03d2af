import { encloseChildren, LEAF, LEFT, NODE_WORDS, RIGHT } from '../layout';
import type { NodeWriter } from './node-writer';

/** Later passes find the rotations that others have made possible. */
const PASSES = 3;

/** Word of the reference to the left (0) or right (1) child; the box of a child starts at word 8 × side, its upper corner 4 later. */
const reference = (side: number) => LEFT + 4 * side;

/** Half the surface of the box around two boxes, given by the words where they start. */
function joined(n: Float32Array, a: number, b: number): number {
  const x0 = n[a] as number, y0 = n[a + 1] as number, z0 = n[a + 2] as number, x1 = n[a + 4] as number, y1 = n[a + 5] as number, z1 = n[a + 6] as number;
  const a0 = n[b] as number, b0 = n[b + 1] as number, c0 = n[b + 2] as number, a1 = n[b + 4] as number, b1 = n[b + 5] as number, c1 = n[b + 6] as number;
  const dx = (x1 > a1 ? x1 : a1) - (x0 < a0 ? x0 : a0), dy = (y1 > b1 ? y1 : b1) - (y0 < b0 ? y0 : b0), dz = (z1 > c1 ? z1 : c1) - (z0 < c0 ? z0 : c0);
  return dx * dy + dy * dz + dz * dx;
}

/**
 * Improves a tree by rotations, from the leaves up: a child changes places with a grandchild where that makes the box
 * between them smaller (Kensler 2008, "Tree Rotations for Improving Bounding Volume Hierarchies"). Afterwards parents need
 * not come before their children any more.
 */
export class Rotations {
  readonly #nodes: Float32Array;
  readonly #words: Uint32Array;
  readonly #maxDepth: number;
  readonly #depths: Uint8Array;
  readonly #heights: Uint8Array;
  /** Nodes with inner children, parents before their children, as rotations have left them. */
  readonly #order: Uint32Array;
  #pass = 0;
  #at = 0;

  /** @param maxDepth Most inner nodes on the way to a leaf. */
  constructor({ nodes, words, count }: NodeWriter, maxDepth: number) {
    this.#nodes = nodes;
    this.#words = words;
    this.#maxDepth = maxDepth;
    this.#depths = new Uint8Array(count);
    this.#heights = new Uint8Array(count);
    this.#order = new Uint32Array(count);
    for (let node = count - 1; node >= 0; node--) this.#measure(node);
  }

  /**
   * Does some of the work.
   *
   * @param nodes How many nodes to look at.
   * @returns Whether there is more to do.
   */
  step(nodes: number): boolean {
    if (this.#at === 0) {
      if (this.#pass === PASSES) return false;
      this.#pass++;
      this.#at = this.#arrange();
    }
    for (const end = Math.max(0, this.#at - nodes); this.#at > end; ) this.#rotate(this.#order[--this.#at] as number);
    return this.#at > 0 || this.#pass < PASSES;
  }

  #height(child: number): number {
    return (child & LEAF) !== 0 ? 0 : (this.#heights[child] as number);
  }

  #measure(node: number): void {
    const left = this.#height(this.#words[node * NODE_WORDS + LEFT] as number), right = this.#height(this.#words[node * NODE_WORDS + RIGHT] as number);
    this.#heights[node] = 1 + (left > right ? left : right);
  }

  /** Lists the nodes with inner children, and counts them. */
  #arrange(): number {
    const words = this.#words, depths = this.#depths, heights = this.#heights, order = this.#order, stack = [0];
    let count = 0;
    depths[0] = 1;
    while (stack.length > 0) {
      const node = stack.pop() as number;
      order[count++] = node;
      const depth = (depths[node] as number) + 1;
      for (let side = 1; side >= 0; side--) {
        const child = words[node * NODE_WORDS + reference(side)] as number;
        if ((child & LEAF) !== 0 || heights[child] === 1) continue;
        depths[child] = depth;
        stack.push(child);
      }
    }
    return count;
  }

  #rotate(node: number): void {
    const nodes = this.#nodes, words = this.#words;
    const base = node * NODE_WORDS;
    let best = 0, bestInner = 0, bestMoved = 0;
    // The child "inner" is opened; the other one may change places with either of its children.
    for (let inner = 0; inner < 2; inner++) {
      const own = base + 8 * inner, other = base + 8 * (1 - inner);
      const opened = words[base + reference(inner)] as number;
      if ((opened & LEAF) !== 0 || (this.#depths[node] as number) + this.#height(words[base + reference(1 - inner)] as number) + 1 > this.#maxDepth) continue;
      const now = joined(nodes, own, own);
      for (let moved = 0; moved < 2; moved++) {
        const gain = now - joined(nodes, other, opened * NODE_WORDS + 8 * (1 - moved));
        if (gain > best) {
          best = gain;
          bestInner = inner;
          bestMoved = moved;
        }
      }
    }
    if (best > 0) {
      const opened = words[base + reference(bestInner)] as number;
      const child = opened * NODE_WORDS, own = base + 8 * bestInner;
      this.#exchange(base, 1 - bestInner, child, bestMoved);
      encloseChildren(nodes, own, own + 4, child);
      this.#measure(opened);
    }
    this.#measure(node);
  }

  /** Swaps a child of the node at word `a` for one of the node at word `b`: reference and box. */
  #exchange(a: number, sideA: number, b: number, sideB: number): void {
    const nodes = this.#nodes, words = this.#words;
    const refA = a + reference(sideA), refB = b + reference(sideB);
    const kept = words[refA] as number;
    words[refA] = words[refB] as number;
    words[refB] = kept;
    for (let k = 0; k < 7; k++) {
      if (k === 3) continue;
      const at = a + 8 * sideA + k, to = b + 8 * sideB + k;
      const value = nodes[at] as number;
      nodes[at] = nodes[to] as number;
      nodes[to] = value;
    }
  }
}

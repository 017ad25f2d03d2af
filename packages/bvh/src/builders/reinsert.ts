import { boxArea, type DraftTree } from './draft';
import { STEP, type Steps } from './steps';

/** Maximum number of pending slots of a search. */
const STACK = 512;

/** Half the surface of the box around two places' boxes. */
function joined(
  boxes: Float32Array,
  p: number,
  x0: number,
  y0: number,
  z0: number,
  x1: number,
  y1: number,
  z1: number,
): number {
  const b = 6 * p;
  const a0 = boxes[b] as number,
    a1 = boxes[b + 1] as number,
    a2 = boxes[b + 2] as number,
    a3 = boxes[b + 3] as number,
    a4 = boxes[b + 4] as number,
    a5 = boxes[b + 5] as number;
  const x = (a3 > x1 ? a3 : x1) - (a0 < x0 ? a0 : x0),
    y = (a4 > y1 ? a4 : y1) - (a1 < y0 ? a1 : y0),
    z = (a5 > z1 ? a5 : z1) - (a2 < z0 ? a2 : z0);
  return x * y + y * z + z * x;
}

/**
 * Improves a tree by removing subtrees and reinserting them where the sum of all surfaces is smallest, the largest
 * ones first (Bittner et al. 2013; the search is that of Meister and Bittner 2018, "Parallel Reinsertion for Bounding
 * Volume Hierarchy Optimization", one subtree after the other).
 */
export class Reinsertion {
  readonly #tree: DraftTree;
  readonly #queue: Uint32Array;
  readonly #stack = new Int32Array(STACK + 2);
  readonly #bounds = new Float64Array(STACK + 2);

  constructor(tree: DraftTree) {
    this.#tree = tree;
    this.#queue = new Uint32Array(2 * tree.itemCount);
  }

  /** One pass over a share of all subtrees, the largest. */
  *pass(share: number): Steps<void> {
    const { areas, itemCount } = this.#tree;
    const queue = this.#queue;
    const places = 2 * itemCount - 1;
    const bits = new Uint32Array(areas.buffer, areas.byteOffset, places);
    // Sorted by the upper half of the floats' bits, which order as the numbers do.
    const starts = new Uint32Array(0x8001);
    for (let i = 0; i < places; i++) {
      const key = 0x7fff - ((bits[i] as number) >>> 16);
      starts[key + 1] = (starts[key + 1] as number) + 1;
      if (i % STEP === 0) yield 0;
    }
    for (let key = 0; key < 0x8000; key++) starts[key + 1] = (starts[key + 1] as number) + (starts[key] as number);
    for (let i = 0; i < places; i++) {
      const key = 0x7fff - ((bits[i] as number) >>> 16);
      const place = starts[key] as number;
      starts[key] = place + 1;
      queue[place] = i;
      if (i % STEP === 0) yield 0;
    }
    const end = Math.ceil(share * places);
    for (let at = 0; at < end;) {
      for (let left = STEP >> 1; left > 0 && at < end;) left -= this.#improve(queue[at++] as number);
      yield at / end;
    }
  }

  /** Searches a better position for a subtree and moves it there. @returns The number of positions visited. */
  #improve(node: number): number {
    const { boxes, areas, parents, children, itemCount } = this.#tree;
    const stack = this.#stack,
      bounds = this.#bounds;
    const root = itemCount,
      parent = parents[node] as number;
    if (parent < 0 || parent === root) return 1;
    const n = 6 * node;
    const x0 = boxes[n] as number,
      y0 = boxes[n + 1] as number,
      z0 = boxes[n + 2] as number,
      x1 = boxes[n + 3] as number,
      y1 = boxes[n + 4] as number,
      z1 = boxes[n + 5] as number;
    const own = areas[node] as number;
    let best = 1e-6 * own,
      target = -1,
      visits = 0;
    // What taking the subtree out saves: its parent, and what the boxes further up shrink by.
    let saved = areas[parent] as number;
    let sibling = this.#sibling(node),
      pivot = parent;
    let p0 = Infinity,
      p1 = Infinity,
      p2 = Infinity,
      p3 = -Infinity,
      p4 = -Infinity,
      p5 = -Infinity;
    for (;;) {
      let top = 0;
      stack[top] = sibling;
      bounds[top++] = saved;
      while (top > 0) {
        const place = stack[--top] as number,
          bound = bounds[top] as number;
        if (bound - own <= best) continue;
        visits++;
        const gain = bound - joined(boxes, place, x0, y0, z0, x1, y1, z1);
        if (gain > best) {
          best = gain;
          target = place;
        }
        // Below, this place grows to the common box.
        const below = gain + (areas[place] as number);
        if (place < itemCount || below - own <= best || top >= STACK) continue;
        stack[top] = children[2 * place] as number;
        bounds[top++] = below;
        stack[top] = children[2 * place + 1] as number;
        bounds[top++] = below;
      }
      if (pivot === root) break;
      const s = 6 * sibling;
      const s0 = boxes[s] as number,
        s1 = boxes[s + 1] as number,
        s2 = boxes[s + 2] as number,
        s3 = boxes[s + 3] as number,
        s4 = boxes[s + 4] as number,
        s5 = boxes[s + 5] as number;
      if (s0 < p0) p0 = s0;
      if (s1 < p1) p1 = s1;
      if (s2 < p2) p2 = s2;
      if (s3 > p3) p3 = s3;
      if (s4 > p4) p4 = s4;
      if (s5 > p5) p5 = s5;
      if (pivot !== parent) {
        const x = p3 - p0,
          y = p4 - p1,
          z = p5 - p2;
        saved += (areas[pivot] as number) - (x * y + y * z + z * x);
      }
      sibling = this.#sibling(pivot);
      pivot = parents[pivot] as number;
    }
    // Beside its sibling it is already.
    if (target < 0 || target === this.#sibling(node) || target === parent) return visits + 4;
    this.#move(node, target);
    return visits + 32;
  }

  #sibling(place: number): number {
    const { parents, children } = this.#tree;
    const parent = parents[place] as number;
    const left = children[2 * parent] as number;
    return left === place ? (children[2 * parent + 1] as number) : left;
  }

  #replace(parent: number, was: number, is: number): void {
    const { children, parents } = this.#tree;
    children[2 * parent + ((children[2 * parent] as number) === was ? 0 : 1)] = is;
    parents[is] = parent;
  }

  /** Takes a subtree out, with its parent, and puts both between a place and what is above that. */
  #move(node: number, target: number): void {
    const { children, parents } = this.#tree;
    const parent = parents[node] as number,
      above = parents[parent] as number;
    this.#replace(above, parent, this.#sibling(node));
    this.#replace(parents[target] as number, target, parent);
    children[2 * parent] = target;
    children[2 * parent + 1] = node;
    parents[target] = parent;
    parents[node] = parent;
    this.#fit(parent);
    this.#encloseUp(above);
    this.#encloseUp(parents[parent] as number);
  }

  /** Fits the boxes from a node up, as far as they change. */
  #encloseUp(from: number): void {
    const { parents } = this.#tree;
    for (let node = from; node >= 0 && this.#fit(node);) node = parents[node] as number;
  }

  /** Fits a node's box to its children's, and says whether it has changed. */
  #fit(node: number): boolean {
    const { boxes, areas, children } = this.#tree;
    const a = 6 * (children[2 * node] as number),
      b = 6 * (children[2 * node + 1] as number),
      to = 6 * node;
    let changed = false;
    for (let k = 0; k < 3; k++) {
      const p = boxes[a + k] as number,
        q = boxes[b + k] as number,
        s = boxes[a + 3 + k] as number,
        t = boxes[b + 3 + k] as number;
      const low = p < q ? p : q,
        high = s > t ? s : t;
      if (boxes[to + k] !== low || boxes[to + 3 + k] !== high) changed = true;
      boxes[to + k] = low;
      boxes[to + 3 + k] = high;
    }
    if (changed) areas[node] = boxArea(boxes, node);
    return changed;
  }
}

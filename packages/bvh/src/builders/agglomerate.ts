import { copyBox, putBox } from '../layout';
import type { NodeWriter } from './node-writer';

/** Maximum number of boxes of one {@link Agglomerator.run}. */
export const GROUP_MAX = 16;
const PLACES = 2 * GROUP_MAX;

/**
 * Builds small trees bottom up: boxes that are each other's nearest, by the surface of their common box, become one,
 * until one is left (Walter et al. 2008, "Fast Agglomerative Clustering for Rendering"). For so few boxes that is both
 * faster and better than trying planes from the top down: a box is two words, and two are joined without a branch.
 *
 * The loops below run more often than any others of a build. So their numbers are constants of the functions
 * themselves, as engines look those of modules up each time, and all integers are in one array, `state`, by sixteens:
 *
 * - for each place of those still to be joined: at 0 the box's upper corner, in steps along the longest side of the
 *   group, nine bits and a guard bit for each coordinate; at 16 the lower corner, complemented; at 32 eight and
 *   the levels below; at 48 the place that joins it best; at 64 which item or node it is;
 * - for each item and node: at 80 the two children of a node, at 144 the levels at and below, at 176 the triangles, at
 *   208 whether it is better a leaf.
 *
 * `load` items, set their `weights` if there are to be leaves of several, call `run`; then the items are 0 to n − 1,
 * the nodes n to 2n − 2 with children before their parents, so the root is 2n − 2. `write` writes the nodes.
 */
export class Agglomerator {
  /** Boxes of items and nodes: min xyz, max xyz. The root's is that of all items. */
  readonly boxes = new Float32Array(6 * PLACES);
  readonly #state = new Int32Array(240);
  /** The two children of node i lie at 2 i and 2 i + 1. */
  readonly children = this.#state.subarray(80, 144);
  /** Triangles under an item or node; those of items are the caller's to set, or 1. */
  readonly weights = this.#state.subarray(176, 208).fill(1);
  /** 1 for items and for nodes that are better a leaf. */
  readonly leaf = this.#state.subarray(208);
  /**
   * Words of the nodes that are written where the reference to an inner node belongs, and 1; 0: in no node that is
   * written.
   */
  readonly #slots = new Uint32Array(PLACES);
  /** Cost of a node or item: area × tests. */
  readonly #costs = new Float64Array(PLACES);
  /** Lower corner of all items. */
  readonly #low = new Float64Array(3);
  readonly #maxLeaf: number;

  /** @param maxLeaf Maximum number of triangles in a leaf; 0: items only. */
  constructor(maxLeaf: number) {
    this.#maxLeaf = maxLeaf;
  }

  /** Takes item `to` from six numbers of `boxes` at `from`. */
  load(to: number, boxes: Float32Array, from: number): void {
    copyBox(this.boxes, 6 * to, 3, boxes, from);
  }

  /**
   * @param count Items, 1 to {@link GROUP_MAX}.
   * @param byTwos Whether to join neighbours in the order given, whatever their boxes: ⌈log₂ count⌉ levels.
   * @returns Levels of nodes.
   */
  run(count: number, byTwos = false): number {
    this.#quantise(count);
    for (let left = count; left > 1;) {
      this.#compare(left, byTwos);
      left = this.#merge(left, 2 * count - left);
    }
    return this.#state[142 + 2 * count] as number;
  }

  /**
   * Writes the nodes of the tree found last, parents before their children; none for a single leaf.
   *
   * @param slot Word of the nodes for the reference to the tree; 0: none.
   * @param reference Gives the reference to the leaf of all under an item or node.
   */
  write(
    { nodes, words, count: next }: NodeWriter,
    count: number,
    slot: number,
    reference: (id: number) => number,
  ): number {
    const CHILDREN = 80,
      LEAVES = 208,
      LEFT = 3,
      RIGHT = 7,
      PARENT = 11,
      RESERVED = 15;
    const { boxes } = this;
    const state = this.#state,
      slots = this.#slots;
    const root = 2 * count - 2;
    slots[root] = slot + 1;
    for (let id = root; id >= count; id--) {
      const l = state[CHILDREN + 2 * id] as number,
        r = state[CHILDREN + 2 * id + 1] as number;
      const above = slots[id] as number;
      if (above === 0 || state[LEAVES + id] === 1) {
        slots[l] = slots[r] = 0;
        continue;
      }
      const base = 16 * next;
      if (above > 1) words[above - 1] = next;
      next++;
      copyBox(nodes, base, 4, boxes, 6 * l);
      copyBox(nodes, base + 8, 4, boxes, 6 * r);
      words[base + PARENT] = above >>> 4;
      words[base + RESERVED] = 0;
      if (state[LEAVES + l] === 1) words[base + LEFT] = reference(l);
      if (state[LEAVES + r] === 1) words[base + RIGHT] = reference(r);
      slots[l] = base + LEFT + 1;
      slots[r] = base + RIGHT + 1;
    }
    return next;
  }

  #quantise(count: number): void {
    const LOW = 16,
      FACTORS = 32,
      IDS = 64,
      HEIGHTS = 144,
      WEIGHTS = 176,
      LEAVES = 208,
      STEPS = 511;
    const { boxes } = this;
    const state = this.#state,
      costs = this.#costs;
    let longest = 0;
    const low = this.#low;
    for (let k = 0; k < 3; k++) {
      let a = Infinity,
        b = -Infinity;
      for (let at = k; at < 6 * count; at += 6) {
        if ((boxes[at] as number) < a) a = boxes[at] as number;
        if ((boxes[at + 3] as number) > b) b = boxes[at + 3] as number;
      }
      low[k] = a;
      if (b - a > longest) longest = b - a;
    }
    // Without extent all are alike.
    const scale = longest > 0 ? STEPS / longest : 0;
    const x = low[0] as number,
      y = low[1] as number,
      z = low[2] as number;
    for (let i = 0, b = 0; i < count; i++, b += 6) {
      const a0 = boxes[b] as number,
        a1 = boxes[b + 1] as number,
        a2 = boxes[b + 2] as number;
      const a3 = boxes[b + 3] as number,
        a4 = boxes[b + 4] as number,
        a5 = boxes[b + 5] as number;
      state[i] = ((a3 - x) * scale) | 0 | (((a4 - y) * scale) << 10) | (((a5 - z) * scale) << 20);
      state[LOW + i] =
        (STEPS - (((a0 - x) * scale) | 0)) |
        ((STEPS - (((a1 - y) * scale) | 0)) << 10) |
        ((STEPS - (((a2 - z) * scale) | 0)) << 20);
      const ex = a3 - a0,
        ey = a4 - a1,
        ez = a5 - a2;
      costs[i] = (ex * ey + ey * ez + ez * ex) * (state[WEIGHTS + i] as number);
      // Where many are alike, as in a regular grid, small trees are joined before large ones.
      state[FACTORS + i] = 8;
      state[IDS + i] = i;
      state[HEIGHTS + i] = 0;
      state[LEAVES + i] = 1;
    }
  }

  /** Finds each place's nearest; among equals the first, so that the nearest two of all are each other's. */
  #compare(left: number, byTwos: boolean): void {
    const LOW = 16,
      FACTORS = 32,
      NEAREST = 48,
      STEPS = 511;
    // The guard bits.
    const GUARD_BITS = 0x20080200;
    const state = this.#state;
    const high0 = state[0] as number,
      low0 = state[LOW] as number;
    let different = 0;
    state[NEAREST] = 0x7fffffff;
    for (let i = 1; i < left; i++) {
      const high = state[i] as number,
        low = state[LOW + i] as number,
        factor = state[FACTORS + i] as number;
      const highGuarded = high | GUARD_BITS,
        lowGuarded = low | GUARD_BITS;
      different |= (high ^ high0) | (low ^ low0);
      let own = 0x7fffffff;
      for (let j = 0; j < i; j++) {
        const highJ = state[j] as number,
          lowJ = state[LOW + j] as number;
        // The common box: the larger of each of the three coordinates.
        const a = (highGuarded - highJ) & GUARD_BITS,
          b = (lowGuarded - lowJ) & GUARD_BITS;
        const extents = ((highJ ^ ((high ^ highJ) & (a - (a >>> 9)))) + (lowJ ^ ((low ^ lowJ) & (b - (b >>> 9))))) | 0;
        const x = (extents & 1023) - STEPS,
          y = ((extents >>> 10) & 1023) - STEPS,
          z = (extents >>> 20) - STEPS;
        const surface = (Math.imul(x, y + z) + Math.imul(y, z)) | 0;
        // Surface and place in one number, and the lesser of two without a branch, which would be a coin toss.
        const d = Math.imul(surface, factor + (state[FACTORS + j] as number)) << 4;
        const forI = (own - (d | j)) | 0;
        own = (own - (forI & ~(forI >> 31))) | 0;
        const theirs = state[NEAREST + j] as number;
        const forJ = (theirs - (d | i)) | 0;
        state[NEAREST + j] = theirs - (forJ & ~(forJ >> 31));
      }
      state[NEAREST + i] = own;
    }
    // Identical boxes are joined in pairs, or one would absorb the others one after the other.
    if (byTwos || different === 0) for (let i = 0; i < left; i++) state[NEAREST + i] = i ^ 1;
  }

  /** Joins those that are each other's nearest, and gives how many are left. */
  #merge(left: number, node: number): number {
    const LOW = 16,
      FACTORS = 32,
      NEAREST = 48,
      IDS = 64,
      HEIGHTS = 144,
      GUARD_BITS = 0x20080200;
    const state = this.#state;
    let kept = 0;
    for (let i = 0; i < left; i++) {
      const j = (state[NEAREST + i] as number) & 15;
      let id = state[IDS + i] as number,
        high = state[i] as number,
        low = state[LOW + i] as number;
      if (j < left && ((state[NEAREST + j] as number) & 15) === i) {
        if (j < i) continue;
        const highJ = state[j] as number,
          lowJ = state[LOW + j] as number;
        const a = ((high | GUARD_BITS) - highJ) & GUARD_BITS,
          b = ((low | GUARD_BITS) - lowJ) & GUARD_BITS;
        high = highJ ^ ((high ^ highJ) & (a - (a >>> 9)));
        low = lowJ ^ ((low ^ lowJ) & (b - (b >>> 9)));
        this.#add(node, id, state[IDS + j] as number);
        id = node++;
      }
      state[kept] = high;
      state[LOW + kept] = low;
      state[FACTORS + kept] = 8 + (state[HEIGHTS + id] as number);
      state[IDS + kept++] = id;
    }
    return kept;
  }

  /**
   * Makes a node, or the leaf that costs less: a leaf costs its area times its triangles, a node its area and its
   * children.
   */
  #add(node: number, left: number, right: number): void {
    const CHILDREN = 80,
      HEIGHTS = 144,
      WEIGHTS = 176,
      LEAVES = 208;
    const { boxes } = this;
    const state = this.#state,
      costs = this.#costs;
    state[CHILDREN + 2 * node] = left;
    state[CHILDREN + 2 * node + 1] = right;
    const a = state[HEIGHTS + left] as number,
      b = state[HEIGHTS + right] as number;
    state[HEIGHTS + node] = 1 + (a > b ? a : b);
    const to = 6 * node,
      l = 6 * left,
      r = 6 * right;
    const l0 = boxes[l] as number,
      l1 = boxes[l + 1] as number,
      l2 = boxes[l + 2] as number,
      l3 = boxes[l + 3] as number,
      l4 = boxes[l + 4] as number,
      l5 = boxes[l + 5] as number;
    const r0 = boxes[r] as number,
      r1 = boxes[r + 1] as number,
      r2 = boxes[r + 2] as number,
      r3 = boxes[r + 3] as number,
      r4 = boxes[r + 4] as number,
      r5 = boxes[r + 5] as number;
    const x0 = l0 < r0 ? l0 : r0,
      y0 = l1 < r1 ? l1 : r1,
      z0 = l2 < r2 ? l2 : r2;
    const x1 = l3 > r3 ? l3 : r3,
      y1 = l4 > r4 ? l4 : r4,
      z1 = l5 > r5 ? l5 : r5;
    putBox(boxes, to, x0, y0, z0, x1, y1, z1);
    const x = x1 - x0,
      y = y1 - y0,
      z = z1 - z0;
    const area = x * y + y * z + z * x;
    const weight = (state[WEIGHTS + left] as number) + (state[WEIGHTS + right] as number);
    const cost = area + (costs[left] as number) + (costs[right] as number),
      together = area * weight;
    const one = weight <= this.#maxLeaf && together <= cost;
    state[WEIGHTS + node] = weight;
    costs[node] = one ? together : cost;
    state[LEAVES + node] = one ? 1 : 0;
  }
}

import { enclose } from '../layout';
import type { NodeWriter } from './node-writer';

/** Most boxes of one {@link Agglomerator.run}. */
export const GROUP_MAX = 16;
const PLACE_BITS = 4;

/**
 * Surfaces are weighed by 2 × this and the levels below both: where many are alike, as in a regular grid, small trees are
 * joined before large ones.
 */
const LEVEL_SHARE = 8;

/** Coordinates are looked at in so many steps along the longest side of the group: nine bits and one to spare, three in a word. */
const STEPS = 511;
const FIELD = 10;
/** The bits to spare. */
const SPARE = (1 << (FIELD - 1)) | (1 << (2 * FIELD - 1)) | (1 << (3 * FIELD - 1));

/** The larger of each of the three fields of two words. */
function larger(a: number, b: number): number {
  const borrowed = ((a | SPARE) - b) & SPARE;
  return b ^ ((a ^ b) & (borrowed - (borrowed >>> (FIELD - 1))));
}

/** Half the surface of a box: the words hold its upper corner and its lower one, turned round. */
function surface(high: number, low: number): number {
  const extents = high + low;
  const x = (extents & 1023) - STEPS, y = ((extents >>> FIELD) & 1023) - STEPS, z = (extents >>> (2 * FIELD)) - STEPS;
  return (Math.imul(x, y + z) + Math.imul(y, z)) | 0;
}

/**
 * Builds small trees bottom up: boxes that are each other's nearest, by the surface of their common box, become one, until
 * one is left (Walter et al. 2008, "Fast Agglomerative Clustering for Rendering"). For so few boxes that is both faster
 * and better than trying planes from the top down: a box is two words, and two are joined without a branch.
 *
 * Fill `boxes` with 6 numbers an item, call `run`; then the items are 0 to n − 1, the nodes n to 2n − 2 with children before
 * their parents, so the root is 2n − 2.
 */
export class Agglomerator {
  /** Boxes of items and nodes: min xyz, max xyz. */
  readonly boxes = new Float32Array(6 * (2 * GROUP_MAX - 1));
  /** The two children of node i lie at 2 i and 2 i + 1. */
  readonly children = new Uint8Array(2 * (2 * GROUP_MAX - 1));
  /** Levels of nodes at and below an item (0) or node. */
  readonly heights = new Uint8Array(2 * GROUP_MAX - 1);

  readonly #box = new Float64Array(6);
  readonly #high = new Int32Array(GROUP_MAX);
  readonly #low = new Int32Array(GROUP_MAX);
  /** {@link LEVEL_SHARE} and the levels below. */
  readonly #factors = new Int32Array(GROUP_MAX);
  /** For each place the one that joins it best. */
  readonly #nearest = new Int32Array(GROUP_MAX);
  readonly #ids = new Uint8Array(GROUP_MAX);
  /** Items and nodes to be written: id, parent, side. */
  readonly #pending = new Int32Array(3 * (GROUP_MAX + 1));

  /**
   * @param count Items, 1 to {@link GROUP_MAX}.
   * @param maxHeight Most levels of nodes; at least ⌈log₂ count⌉. Where that is too few for the tree found, neighbours in
   * the order given are joined instead.
   */
  run(count: number, maxHeight: number): void {
    this.#join(count, false);
    if ((this.heights[2 * count - 2] as number) > maxHeight) this.#join(count, true);
  }

  /**
   * Writes the tree found last, depth first.
   *
   * @param parent The node above; −1: none.
   * @param right Which child of that it is.
   * @param leaf Gives the reference to a leaf of all under an item or node; 0 where a node is to be written.
   */
  write(writer: NodeWriter, count: number, parent: number, right: number, leaf: (id: number) => number): void {
    const { boxes, children } = this;
    const pending = this.#pending;
    pending[0] = 2 * count - 2;
    pending[1] = parent;
    pending[2] = right;
    for (let top = 3; top > 0; ) {
      top -= 3;
      const id = pending[top] as number, above = pending[top + 1] as number, side = pending[top + 2] as number;
      let reference = leaf(id);
      if (reference === 0) {
        reference = writer.add(above);
        for (let k = 1; k >= 0; k--) {
          pending[top] = children[2 * id + k] as number;
          pending[top + 1] = reference;
          pending[top + 2] = k;
          top += 3;
        }
      }
      if (above >= 0) writer.childBox(above, side === 1, reference, boxes, 6 * id);
    }
  }

  /** @param byTwos Whether to join neighbours, whatever their boxes. */
  #join(count: number, byTwos: boolean): void {
    this.#quantise(count);
    for (let left = count; left > 1; ) {
      this.#compare(left, byTwos);
      left = this.#merge(left, 2 * count - left);
    }
  }

  #quantise(count: number): void {
    const { boxes, heights } = this;
    const high = this.#high, low = this.#low, factors = this.#factors, ids = this.#ids;
    const box = this.#box;
    enclose(boxes, 0, count, box);
    const x = box[0] as number, y = box[1] as number, z = box[2] as number;
    const dx = (box[3] as number) - x, dy = (box[4] as number) - y, dz = (box[5] as number) - z;
    const longest = dx > dy ? (dx > dz ? dx : dz) : dy > dz ? dy : dz;
    const step = STEPS / longest;
    // Without extent, or with one that is next to nothing, all are alike.
    const scale = step < Infinity ? step : 0;
    for (let i = 0, b = 0; i < count; i++, b += 6) {
      low[i] = (STEPS - ((((boxes[b] as number) - x) * scale) | 0)) | ((STEPS - ((((boxes[b + 1] as number) - y) * scale) | 0)) << FIELD) | ((STEPS - ((((boxes[b + 2] as number) - z) * scale) | 0)) << (2 * FIELD));
      high[i] = (((boxes[b + 3] as number) - x) * scale) | ((((boxes[b + 4] as number) - y) * scale) << FIELD) | ((((boxes[b + 5] as number) - z) * scale) << (2 * FIELD));
      factors[i] = LEVEL_SHARE;
      ids[i] = i;
      heights[i] = 0;
    }
  }

  /** Finds each place's nearest; among equals the first, so that the nearest two of all are each other's. */
  #compare(left: number, byTwos: boolean): void {
    const high = this.#high, low = this.#low, factors = this.#factors, nearest = this.#nearest;
    const high0 = high[0] as number, low0 = low[0] as number;
    let alike = true;
    nearest[0] = 0x7fffffff;
    for (let i = 1; i < left; i++) {
      const highI = high[i] as number, lowI = low[i] as number, factorI = factors[i] as number;
      if (highI !== high0 || lowI !== low0) alike = false;
      let own = 0x7fffffff;
      for (let j = 0; j < i; j++) {
        // Surface and place in one number, and the lesser of two without a branch, which would be a coin toss.
        const d = Math.imul(surface(larger(highI, high[j] as number), larger(lowI, low[j] as number)), factorI + (factors[j] as number)) << PLACE_BITS;
        const forI = (own - (d | j)) | 0;
        own = (own - (forI & ~(forI >> 31))) | 0;
        const theirs = nearest[j] as number;
        const forJ = (theirs - (d | i)) | 0;
        nearest[j] = theirs - (forJ & ~(forJ >> 31));
      }
      nearest[i] = own;
    }
    // Identical boxes: by twos, or one would swallow the others one after the other.
    for (let i = 0; i < left; i++) nearest[i] = byTwos || alike ? i ^ 1 : (nearest[i] as number) & (GROUP_MAX - 1);
  }

  /** Joins those that are each other's nearest, and gives how many are left. */
  #merge(left: number, node: number): number {
    const { heights } = this;
    const high = this.#high, low = this.#low, factors = this.#factors, nearest = this.#nearest, ids = this.#ids;
    let kept = 0;
    for (let i = 0; i < left; i++) {
      const j = nearest[i] as number;
      let id = ids[i] as number, highI = high[i] as number, lowI = low[i] as number;
      if (j < left && nearest[j] === i) {
        if (j < i) continue;
        highI = larger(highI, high[j] as number);
        lowI = larger(lowI, low[j] as number);
        this.#add(node, id, ids[j] as number);
        id = node++;
      }
      high[kept] = highI;
      low[kept] = lowI;
      factors[kept] = LEVEL_SHARE + (heights[id] as number);
      ids[kept++] = id;
    }
    return kept;
  }

  #add(node: number, left: number, right: number): void {
    const { boxes, children, heights } = this;
    children[2 * node] = left;
    children[2 * node + 1] = right;
    const a = heights[left] as number, b = heights[right] as number;
    heights[node] = 1 + (a > b ? a : b);
    const to = 6 * node, l = 6 * left, r = 6 * right;
    for (let k = 0; k < 3; k++) {
      const p = boxes[l + k] as number, q = boxes[r + k] as number, s = boxes[l + 3 + k] as number, t = boxes[r + 3 + k] as number;
      boxes[to + k] = p < q ? p : q;
      boxes[to + 3 + k] = s > t ? s : t;
    }
  }
}

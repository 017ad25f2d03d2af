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

  readonly #high = new Int32Array(GROUP_MAX);
  readonly #low = new Int32Array(GROUP_MAX);
  /** {@link LEVEL_SHARE} and the levels below. */
  readonly #factors = new Int32Array(GROUP_MAX);
  /** For each place the one that joins it best. */
  readonly #nearest = new Int32Array(GROUP_MAX);
  readonly #ids = new Uint8Array(GROUP_MAX);

  /**
   * @param count Items, 1 to {@link GROUP_MAX}.
   * @param maxHeight Most levels of nodes; at least ⌈log₂ count⌉. Where that is too few for the tree found, neighbours in
   * the order given are joined instead.
   */
  run(count: number, maxHeight: number): void {
    this.#quantise(count);
    for (let left = count; left > 1; ) {
      this.#compare(left);
      left = this.#merge(left, 2 * count - left);
    }
    if ((this.heights[2 * count - 2] as number) > maxHeight) this.#halve(count);
  }

  #quantise(count: number): void {
    const { boxes, heights } = this;
    const high = this.#high, low = this.#low, factors = this.#factors, ids = this.#ids;
    let x = Infinity, y = Infinity, z = Infinity, x1 = -Infinity, y1 = -Infinity, z1 = -Infinity;
    const end = 6 * count;
    for (let b = 0; b < end; b += 6) {
      const a0 = boxes[b] as number, a1 = boxes[b + 1] as number, a2 = boxes[b + 2] as number;
      const a3 = boxes[b + 3] as number, a4 = boxes[b + 4] as number, a5 = boxes[b + 5] as number;
      if (a0 < x) x = a0;
      if (a1 < y) y = a1;
      if (a2 < z) z = a2;
      if (a3 > x1) x1 = a3;
      if (a4 > y1) y1 = a4;
      if (a5 > z1) z1 = a5;
    }
    const dx = x1 - x, dy = y1 - y, dz = z1 - z;
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
  #compare(left: number): void {
    const high = this.#high, low = this.#low, factors = this.#factors, nearest = this.#nearest;
    let least = 0x7fffffff, most = 0;
    nearest[0] = 0x7fffffff;
    for (let i = 1; i < left; i++) {
      const highI = high[i] as number, lowI = low[i] as number, factorI = factors[i] as number;
      let own = 0x7fffffff;
      for (let j = 0; j < i; j++) {
        // Surface and place in one number, and the lesser of two without a branch, which would be a coin toss.
        const d = Math.imul(surface(larger(highI, high[j] as number), larger(lowI, low[j] as number)), factorI + (factors[j] as number)) << PLACE_BITS;
        const forI = (own - (d | j)) | 0;
        own = (own - (forI & ~(forI >> 31))) | 0;
        const theirs = nearest[j] as number;
        const forJ = (theirs - (d | i)) | 0;
        nearest[j] = theirs - (forJ & ~(forJ >> 31));
        const beyond = (d - most) | 0;
        most = (most + (beyond & ~(beyond >> 31))) | 0;
      }
      nearest[i] = own;
      const under = (least - own) | 0;
      least = (least - (under & ~(under >> 31))) | 0;
    }
    // All alike: by twos, or one would swallow the others one after the other.
    const alike = least >> PLACE_BITS === most >> PLACE_BITS;
    for (let i = 0; i < left; i++) nearest[i] = alike ? i ^ 1 : (nearest[i] as number) & (GROUP_MAX - 1);
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
        this.#join(node, id, ids[j] as number);
        id = node++;
      }
      high[kept] = highI;
      low[kept] = lowI;
      factors[kept] = LEVEL_SHARE + (heights[id] as number);
      ids[kept++] = id;
    }
    return kept;
  }

  #join(node: number, left: number, right: number): void {
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

  #halve(count: number): void {
    const ids = this.#ids;
    for (let i = 0; i < count; i++) ids[i] = i;
    for (let left = count, node = count; left > 1; left = (left + 1) >> 1) {
      for (let i = 0; i < left; i += 2) {
        if (i + 1 < left) this.#join(node, ids[i] as number, ids[i + 1] as number);
        ids[i >> 1] = i + 1 < left ? node++ : (ids[i] as number);
      }
    }
  }
}

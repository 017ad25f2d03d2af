/**
 * Coordinates are quantised to 32767 steps along the longest side: fifteen bits and a guard bit, two in a word. The
 * words of an item: for each of x, y and z the upper coordinate, and in the high half the lower one complemented; then
 * its number.
 */
const ITEM_WORDS = 4;

/** The larger of both fields of two words. */
function larger(a: number, b: number): number {
  // Local constants, here and below: engines look up those of modules on each access.
  const GUARD_BITS = 0x80008000 | 0;
  const borrowed = ((a | GUARD_BITS) - b) & GUARD_BITS;
  return b ^ ((a ^ b) & (borrowed - (borrowed >>> 15)));
}

/** The length of a box along the axis of a word. */
const extent = (word: number): number => (word & 32767) + (word >>> 16) - 32767;

/** Half the surface of a box of three words. */
function surface(a: number, b: number, c: number): number {
  const x = extent(a),
    y = extent(b),
    z = extent(c);
  return x * (y + z) + y * z;
}

/** Enlarges the bin at a word by a box and a weight. */
function addTo(bins: Int32Array, at: number, a: number, b: number, c: number, weight: number): void {
  bins[at] = larger(bins[at] as number, a);
  bins[at + 1] = larger(bins[at + 1] as number, b);
  bins[at + 2] = larger(bins[at + 2] as number, c);
  bins[at + 3] = ((bins[at + 3] as number) + weight) | 0;
}

/**
 * Finds splits of ranges of boxes by surface area heuristic, with all scratch memory it needs: boxes are three words,
 * which are joined without a branch. After `split()`, `cut` is where the range was cut: in the middle if no plane
 * separates the centres. Items themselves are permuted, so that ranges are read from one end to the other.
 */
export class Splitter {
  cut = 0;
  /** Where the centres of both sides lie, doubled: min xyz, max xyz. */
  readonly left = new Int32Array(6);
  readonly right = new Int32Array(6);
  readonly #bins: number;
  /** For each axis its bins: three words and a weight each. */
  readonly #binned: Int32Array;
  readonly #leftCosts: Float64Array;
  readonly #scales = new Int32Array(3);

  constructor(bins: number) {
    this.#bins = bins;
    this.#binned = new Int32Array(3 * bins * ITEM_WORDS);
    this.#leftCosts = new Float64Array(bins);
  }

  /**
   * Tries the planes between bins along all three axes (Wald 2007).
   *
   * @param items Those from `first` up to `end` are permuted.
   * @param weights By number; default 1.
   * @param centers Bounds of the centres of those from `first` up to `end`, doubled: min xyz, max xyz.
   * @param maxSide Maximum number of items on a side, at least half of them. Where the best plane leaves more on one,
   * the cut moves along the same axis until it has no more.
   */
  split(
    items: Int32Array,
    weights: Uint32Array | undefined,
    first: number,
    end: number,
    centers: Int32Array,
    maxSide: number,
  ): void {
    const { left, right } = this,
      scales = this.#scales,
      bins = this.#bins;
    this.cut = (first + end) >>> 1;
    for (let axis = 0; axis < 3; axis++)
      scales[axis] = (bins * 2 ** 24) / ((centers[3 + axis] as number) - (centers[axis] as number) + 1);
    left.set(centers);
    right.set(centers);
    this.#fill(items, weights, first, end, centers);
    let best = Infinity,
      bestAxis = -1,
      bestBin = 0;
    for (let axis = 0; axis < 3; axis++) {
      const plane = this.#sweep(axis, best);
      if (plane < 0) continue;
      best = this.#cost;
      bestAxis = axis;
      bestBin = plane;
    }
    if (bestAxis < 0) return;
    const minCut = end - maxSide,
      maxCut = first + maxSide;
    let low = centers[bestAxis] as number,
      high = centers[3 + bestAxis] as number;
    for (;;) {
      this.#partition(items, first, end, bestAxis, bestBin, low);
      // Where a side is too large, halve the range of its centres until the cut is far enough in it.
      if (this.cut < minCut) {
        first = this.cut;
        low = right[bestAxis] as number;
      } else if (this.cut > maxCut) {
        end = this.cut;
        high = left[3 + bestAxis] as number;
      } else return;
      if (low === high) {
        left[3 + bestAxis] = right[bestAxis] = low;
        this.cut = minCut;
        return;
      }
      bestBin = 1;
      scales[bestAxis] = 2 ** 25 / (high - low + 1);
    }
  }

  #partition(items: Int32Array, first: number, end: number, axis: number, plane: number, low: number): void {
    const STEPS = 32767,
      ITEM_WORDS = 4;
    const scale = this.#scales[axis] as number;
    let i = first,
      j = end;
    let leftMax = 0,
      rightMin = 2 * STEPS;
    while (i < j) {
      const word = items[i * ITEM_WORDS + axis] as number;
      const center = (word & STEPS) + STEPS - (word >>> 16);
      if (Math.imul(center - low, scale) >>> 24 < plane) {
        i++;
        if (center > leftMax) leftMax = center;
      } else {
        j--;
        for (let k = 0; k < ITEM_WORDS; k++) {
          const a = i * ITEM_WORDS + k,
            b = j * ITEM_WORDS + k;
          [items[a], items[b]] = [items[b] as number, items[a] as number];
        }
        if (center < rightMin) rightMin = center;
      }
    }
    this.cut = i;
    this.left[3 + axis] = leftMax;
    this.right[axis] = rightMin;
  }

  #fill(items: Int32Array, weights: Uint32Array | undefined, first: number, end: number, centers: Int32Array): void {
    const STEPS = 32767,
      ITEM_WORDS = 4;
    const binned = this.#binned,
      scales = this.#scales;
    const axisWords = this.#bins * ITEM_WORDS;
    binned.fill(0);
    const lowX = (centers[0] as number) - STEPS,
      lowY = (centers[1] as number) - STEPS,
      lowZ = (centers[2] as number) - STEPS;
    const scaleX = scales[0] as number,
      scaleY = scales[1] as number,
      scaleZ = scales[2] as number;
    for (let w = first * ITEM_WORDS; w < end * ITEM_WORDS; w += ITEM_WORDS) {
      const a = items[w] as number,
        b = items[w + 1] as number,
        c = items[w + 2] as number,
        weight = weights?.[items[w + 3] as number] ?? 1;
      const x = (Math.imul((a & STEPS) - (a >>> 16) - lowX, scaleX) >>> 24) * ITEM_WORDS;
      const y = (Math.imul((b & STEPS) - (b >>> 16) - lowY, scaleY) >>> 24) * ITEM_WORDS + axisWords;
      const z = (Math.imul((c & STEPS) - (c >>> 16) - lowZ, scaleZ) >>> 24) * ITEM_WORDS + 2 * axisWords;
      addTo(binned, x, a, b, c, weight);
      addTo(binned, y, a, b, c, weight);
      addTo(binned, z, a, b, c, weight);
    }
  }

  /** Cost of the plane found last: Σ area × weight of both sides. */
  #cost = 0;

  /** The first bin behind the best plane that costs less than `best`; −1 if there is none. */
  #sweep(axis: number, best: number): number {
    const binned = this.#binned,
      leftCosts = this.#leftCosts,
      bins = this.#bins;
    let plane = -1;
    // Up and down again: costs of all left sides first.
    for (let direction = 1; direction >= -1; direction -= 2) {
      let a = 0,
        b = 0,
        c = 0,
        weight = 0;
      for (let n = 1, bin = direction > 0 ? 0 : bins - 1; n < bins; n++, bin += direction) {
        const at = 4 * (axis * bins + bin);
        a = larger(a, binned[at] as number);
        b = larger(b, binned[at + 1] as number);
        c = larger(c, binned[at + 2] as number);
        weight = (weight + (binned[at + 3] as number)) | 0;
        const cost = weight === 0 ? Infinity : surface(a, b, c) * weight;
        if (direction > 0) leftCosts[bin] = cost;
        else if (cost + (leftCosts[bin - 1] as number) < best) {
          best = this.#cost = cost + (leftCosts[bin - 1] as number);
          plane = bin;
        }
      }
    }
    return plane;
  }
}

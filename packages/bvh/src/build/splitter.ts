import { putBox } from '../layout';

/**
 * Finds splits of ranges of boxes by surface area heuristic, with all scratch memory it needs. After `split()`, `cut` is
 * where the range was cut (the order is permuted), or −1 if it was not or no plane separates the centres.
 */
export class Splitter {
  cut = -1;
  /** Box of the range that was looked at last, and of its centres, doubled: min xyz, max xyz. */
  readonly box = new Float64Array(6);
  readonly #centers = new Float64Array(6);
  readonly #bins: number;
  readonly #boxes: Float64Array;
  readonly #weights: Float64Array;
  readonly #leftCosts: Float64Array;

  constructor(bins: number) {
    this.#bins = bins;
    this.#boxes = new Float64Array(bins * 6);
    this.#weights = new Float64Array(bins);
    this.#leftCosts = new Float64Array(bins);
  }

  /**
   * Measures `order[first, end)` and tries the planes between bins along all three axes (Wald 2007).
   *
   * @param free False: only measures.
   */
  split(boxes: Float32Array, weights: Uint32Array, order: Uint32Array, first: number, end: number, free: boolean): void {
    this.#measure(boxes, order, first, end);
    this.cut = -1;
    if (!free) return;
    const centers = this.#centers;
    const bins = end - first < 64 ? 8 : this.#bins;
    let best = Infinity, bestAxis = -1, bestBin = 0, bestScale = 0;
    for (let axis = 0; axis < 3; axis++) {
      const low = centers[axis] as number;
      // Just below the number of bins, so that the largest centre falls into the last.
      const scale = (bins * 0.999999) / ((centers[3 + axis] as number) - low);
      // Without extent there is no plane between.
      if (!(scale < Infinity)) continue;
      this.#fill(boxes, weights, order, first, end, axis, low, scale, bins);
      const plane = this.#sweep(bins, best);
      if (plane < 0) continue;
      best = this.#cost;
      bestAxis = axis;
      bestBin = plane;
      bestScale = scale;
    }
    if (bestAxis < 0) return;
    const low = centers[bestAxis] as number;
    let i = first, j = end;
    while (i < j) {
      const item = order[i] as number;
      const b = 6 * item + bestAxis;
      if ((((boxes[b] as number) + (boxes[b + 3] as number) - low) * bestScale | 0) < bestBin) i++;
      else {
        order[i] = order[--j] as number;
        order[j] = item;
      }
    }
    this.cut = i;
  }

  #measure(boxes: Float32Array, order: Uint32Array, first: number, end: number): void {
    let x0 = Infinity, y0 = Infinity, z0 = Infinity, x1 = -Infinity, y1 = -Infinity, z1 = -Infinity;
    let cx0 = Infinity, cy0 = Infinity, cz0 = Infinity, cx1 = -Infinity, cy1 = -Infinity, cz1 = -Infinity;
    for (let i = first; i < end; i++) {
      const b = 6 * (order[i] as number);
      const a0 = boxes[b] as number, a1 = boxes[b + 1] as number, a2 = boxes[b + 2] as number;
      const a3 = boxes[b + 3] as number, a4 = boxes[b + 4] as number, a5 = boxes[b + 5] as number;
      if (a0 < x0) x0 = a0;
      if (a1 < y0) y0 = a1;
      if (a2 < z0) z0 = a2;
      if (a3 > x1) x1 = a3;
      if (a4 > y1) y1 = a4;
      if (a5 > z1) z1 = a5;
      const cx = a0 + a3, cy = a1 + a4, cz = a2 + a5;
      if (cx < cx0) cx0 = cx;
      if (cy < cy0) cy0 = cy;
      if (cz < cz0) cz0 = cz;
      if (cx > cx1) cx1 = cx;
      if (cy > cy1) cy1 = cy;
      if (cz > cz1) cz1 = cz;
    }
    putBox(this.box, 0, x0, y0, z0, x1, y1, z1);
    putBox(this.#centers, 0, cx0, cy0, cz0, cx1, cy1, cz1);
  }

  #fill(boxes: Float32Array, weights: Uint32Array, order: Uint32Array, first: number, end: number, axis: number, low: number, scale: number, bins: number): void {
    const binBoxes = this.#boxes, binWeights = this.#weights;
    for (let bin = 0; bin < bins; bin++) {
      putBox(binBoxes, 6 * bin, Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity);
      binWeights[bin] = 0;
    }
    for (let i = first; i < end; i++) {
      const item = order[i] as number;
      const b = 6 * item;
      let bin = (((boxes[b + axis] as number) + (boxes[b + axis + 3] as number) - low) * scale) | 0;
      binWeights[bin] = (binWeights[bin] as number) + (weights[item] as number);
      bin *= 6;
      const a0 = boxes[b] as number, a1 = boxes[b + 1] as number, a2 = boxes[b + 2] as number;
      const a3 = boxes[b + 3] as number, a4 = boxes[b + 4] as number, a5 = boxes[b + 5] as number;
      if (a0 < (binBoxes[bin] as number)) binBoxes[bin] = a0;
      if (a1 < (binBoxes[bin + 1] as number)) binBoxes[bin + 1] = a1;
      if (a2 < (binBoxes[bin + 2] as number)) binBoxes[bin + 2] = a2;
      if (a3 > (binBoxes[bin + 3] as number)) binBoxes[bin + 3] = a3;
      if (a4 > (binBoxes[bin + 4] as number)) binBoxes[bin + 4] = a4;
      if (a5 > (binBoxes[bin + 5] as number)) binBoxes[bin + 5] = a5;
    }
  }

  /** Cost of the plane found last: Σ area × weight of both sides. */
  #cost = 0;

  /** The first bin behind the best plane that costs less than `best`; −1 if there is none. */
  #sweep(bins: number, best: number): number {
    const binBoxes = this.#boxes, binWeights = this.#weights, leftCosts = this.#leftCosts;
    let plane = -1;
    // Up and down again: costs of all left sides first.
    for (let direction = 1; direction >= -1; direction -= 2) {
      let weight = 0, x0 = Infinity, y0 = Infinity, z0 = Infinity, x1 = -Infinity, y1 = -Infinity, z1 = -Infinity;
      for (let n = 1, bin = direction > 0 ? 0 : bins - 1; n < bins; n++, bin += direction) {
        const b = 6 * bin;
        weight += binWeights[bin] as number;
        if ((binBoxes[b] as number) < x0) x0 = binBoxes[b] as number;
        if ((binBoxes[b + 1] as number) < y0) y0 = binBoxes[b + 1] as number;
        if ((binBoxes[b + 2] as number) < z0) z0 = binBoxes[b + 2] as number;
        if ((binBoxes[b + 3] as number) > x1) x1 = binBoxes[b + 3] as number;
        if ((binBoxes[b + 4] as number) > y1) y1 = binBoxes[b + 4] as number;
        if ((binBoxes[b + 5] as number) > z1) z1 = binBoxes[b + 5] as number;
        const dx = x1 - x0, dy = y1 - y0, dz = z1 - z0;
        const cost = weight === 0 ? Infinity : weight * (dx * dy + dy * dz + dz * dx);
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

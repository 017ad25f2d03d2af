/**
 * Finds splits of ranges of boxes by surface area heuristic, with all scratch memory it needs. After `bin()`, `cut` is
 * where the range was cut (the order is permuted), or −1 if no plane separates the centres.
 */
export class Splitter {
  cut = -1;
  cost = Infinity;
  // Box of the range that was looked at last.
  x0 = 0;
  y0 = 0;
  z0 = 0;
  x1 = 0;
  y1 = 0;
  z1 = 0;
  // Box of the centres, doubled: lower corner and extent.
  cx0 = 0;
  cy0 = 0;
  cz0 = 0;
  ex = 0;
  ey = 0;
  ez = 0;

  readonly #bins: number;
  readonly #binBoxes: Float64Array;
  readonly #binWeights: Float64Array;
  readonly #leftCosts: Float64Array;

  constructor(bins: number) {
    this.#bins = bins;
    this.#binBoxes = new Float64Array(3 * bins * 6);
    this.#binWeights = new Float64Array(3 * bins);
    this.#leftCosts = new Float64Array(bins);
  }

  /** Box and weight of `order[first, end)`, and the box of the centres (doubled), without a split. */
  measure(boxes: Float32Array, order: Uint32Array, first: number, end: number): void {
    let x0 = Infinity, y0 = Infinity, z0 = Infinity, x1 = -Infinity, y1 = -Infinity, z1 = -Infinity;
    let cx0 = Infinity, cy0 = Infinity, cz0 = Infinity, cx1 = -Infinity, cy1 = -Infinity, cz1 = -Infinity;
    for (let i = first; i < end; i++) {
      const item = order[i] as number;
      const b = 6 * item;
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
    this.x0 = x0;
    this.y0 = y0;
    this.z0 = z0;
    this.x1 = x1;
    this.y1 = y1;
    this.z1 = z1;
    this.cx0 = cx0;
    this.cy0 = cy0;
    this.cz0 = cz0;
    this.ex = cx1 - cx0;
    this.ey = cy1 - cy0;
    this.ez = cz1 - cz0;
    this.cut = -1;
    this.cost = Infinity;
  }

  /** Tries the planes between bins along all three axes (Wald 2007). Measures the range as well. */
  bin(boxes: Float32Array, weights: Uint32Array, order: Uint32Array, first: number, end: number): void {
    const bins = end - first < 64 ? 8 : this.#bins;
    const binBoxes = this.#binBoxes, binWeights = this.#binWeights, leftCosts = this.#leftCosts;
    this.measure(boxes, order, first, end);
    const { cx0, cy0, cz0, ex, ey, ez } = this;
    // Axes without extent put everything into one bin, where no plane is. Just below the number of bins, so that the
    // largest centre falls into the last.
    const most = bins * 0.999999;
    const kx = ex > 0 ? most / ex : 0, ky = ey > 0 ? most / ey : 0, kz = ez > 0 ? most / ez : 0;
    if (!(kx < Infinity && ky < Infinity && kz < Infinity)) return;
    const used = 3 * bins;
    for (let i = 0, b = 0; i < used; i++, b += 6) {
      binBoxes[b] = binBoxes[b + 1] = binBoxes[b + 2] = Infinity;
      binBoxes[b + 3] = binBoxes[b + 4] = binBoxes[b + 5] = -Infinity;
      binWeights[i] = 0;
    }
    for (let i = first; i < end; i++) {
      const item = order[i] as number;
      const b = 6 * item;
      const a0 = boxes[b] as number, a1 = boxes[b + 1] as number, a2 = boxes[b + 2] as number;
      const a3 = boxes[b + 3] as number, a4 = boxes[b + 4] as number, a5 = boxes[b + 5] as number;
      const own = weights[item] as number;
      let bin = ((a0 + a3 - cx0) * kx) | 0;
      binWeights[bin] = (binWeights[bin] as number) + own;
      bin *= 6;
      if (a0 < (binBoxes[bin] as number)) binBoxes[bin] = a0;
      if (a1 < (binBoxes[bin + 1] as number)) binBoxes[bin + 1] = a1;
      if (a2 < (binBoxes[bin + 2] as number)) binBoxes[bin + 2] = a2;
      if (a3 > (binBoxes[bin + 3] as number)) binBoxes[bin + 3] = a3;
      if (a4 > (binBoxes[bin + 4] as number)) binBoxes[bin + 4] = a4;
      if (a5 > (binBoxes[bin + 5] as number)) binBoxes[bin + 5] = a5;
      bin = bins + (((a1 + a4 - cy0) * ky) | 0);
      binWeights[bin] = (binWeights[bin] as number) + own;
      bin *= 6;
      if (a0 < (binBoxes[bin] as number)) binBoxes[bin] = a0;
      if (a1 < (binBoxes[bin + 1] as number)) binBoxes[bin + 1] = a1;
      if (a2 < (binBoxes[bin + 2] as number)) binBoxes[bin + 2] = a2;
      if (a3 > (binBoxes[bin + 3] as number)) binBoxes[bin + 3] = a3;
      if (a4 > (binBoxes[bin + 4] as number)) binBoxes[bin + 4] = a4;
      if (a5 > (binBoxes[bin + 5] as number)) binBoxes[bin + 5] = a5;
      bin = 2 * bins + (((a2 + a5 - cz0) * kz) | 0);
      binWeights[bin] = (binWeights[bin] as number) + own;
      bin *= 6;
      if (a0 < (binBoxes[bin] as number)) binBoxes[bin] = a0;
      if (a1 < (binBoxes[bin + 1] as number)) binBoxes[bin + 1] = a1;
      if (a2 < (binBoxes[bin + 2] as number)) binBoxes[bin + 2] = a2;
      if (a3 > (binBoxes[bin + 3] as number)) binBoxes[bin + 3] = a3;
      if (a4 > (binBoxes[bin + 4] as number)) binBoxes[bin + 4] = a4;
      if (a5 > (binBoxes[bin + 5] as number)) binBoxes[bin + 5] = a5;
    }
    let bestAxis = -1, bestBin = 0, bestCost = Infinity;
    for (let axis = 0; axis < 3; axis++) {
      const base = axis * bins;
      let sum = 0, a0 = Infinity, a1 = Infinity, a2 = Infinity, a3 = -Infinity, a4 = -Infinity, a5 = -Infinity;
      for (let bin = 0; bin < bins - 1; bin++) {
        const o = (base + bin) * 6;
        sum += binWeights[base + bin] as number;
        if ((binBoxes[o] as number) < a0) a0 = binBoxes[o] as number;
        if ((binBoxes[o + 1] as number) < a1) a1 = binBoxes[o + 1] as number;
        if ((binBoxes[o + 2] as number) < a2) a2 = binBoxes[o + 2] as number;
        if ((binBoxes[o + 3] as number) > a3) a3 = binBoxes[o + 3] as number;
        if ((binBoxes[o + 4] as number) > a4) a4 = binBoxes[o + 4] as number;
        if ((binBoxes[o + 5] as number) > a5) a5 = binBoxes[o + 5] as number;
        const dx = a3 - a0, dy = a4 - a1, dz = a5 - a2;
        leftCosts[bin] = sum === 0 ? Infinity : sum * (dx * dy + dy * dz + dz * dx);
      }
      sum = 0;
      a0 = a1 = a2 = Infinity;
      a3 = a4 = a5 = -Infinity;
      for (let bin = bins - 1; bin > 0; bin--) {
        const o = (base + bin) * 6;
        sum += binWeights[base + bin] as number;
        if ((binBoxes[o] as number) < a0) a0 = binBoxes[o] as number;
        if ((binBoxes[o + 1] as number) < a1) a1 = binBoxes[o + 1] as number;
        if ((binBoxes[o + 2] as number) < a2) a2 = binBoxes[o + 2] as number;
        if ((binBoxes[o + 3] as number) > a3) a3 = binBoxes[o + 3] as number;
        if ((binBoxes[o + 4] as number) > a4) a4 = binBoxes[o + 4] as number;
        if ((binBoxes[o + 5] as number) > a5) a5 = binBoxes[o + 5] as number;
        if (sum === 0) continue;
        const dx = a3 - a0, dy = a4 - a1, dz = a5 - a2;
        const cost = sum * (dx * dy + dy * dz + dz * dx) + (leftCosts[bin - 1] as number);
        if (cost < bestCost) {
          bestCost = cost;
          bestAxis = axis;
          bestBin = bin;
        }
      }
    }
    if (bestAxis < 0) return;
    const low = bestAxis === 0 ? cx0 : bestAxis === 1 ? cy0 : cz0;
    const scale = bestAxis === 0 ? kx : bestAxis === 1 ? ky : kz;
    let i = first, j = end;
    while (i < j) {
      const item = order[i] as number;
      const b = 6 * item + bestAxis;
      if ((((boxes[b] as number) + (boxes[b + 3] as number) - low) * scale | 0) < bestBin) i++;
      else {
        order[i] = order[--j] as number;
        order[j] = item;
      }
    }
    this.cut = i;
    this.cost = bestCost;
  }
}

import type { Primitives } from './primitives';

/** Cells per axis. */
const CELLS = 1024;
/** Bits of one pass of the sort. */
const DIGIT = 10;

/** Primitives in the order of a space-filling curve. */
export interface Sorted {
  /** Primitives, by their Morton codes. */
  readonly order: Uint32Array;
  /** Morton codes in that order, 30 bits. */
  readonly codes: Uint32Array;
}

/**
 * Sorts primitives by the Morton codes of their boxes' centres, in cubic cells, by radix.
 * Equal codes keep their order, so the result is one for all machines.
 */
export function sortByMorton({ boxes, count, bounds }: Primitives): Sorted {
  // Spreads ten bits to every third place.
  const spread = new Uint32Array(CELLS);
  for (let i = 0; i < CELLS; i++) for (let bit = 0; bit < DIGIT; bit++) spread[i] = (spread[i] as number) | (((i >> bit) & 1) << (3 * bit));
  const [x, y, z, x1, y1, z1] = bounds as unknown as [number, number, number, number, number, number];
  const extent = Math.max(x1 - x, y1 - y, z1 - z);
  const scale = extent > 0 ? (0.5 * CELLS) / extent : 0;
  const ox = 2 * x, oy = 2 * y, oz = 2 * z, last = CELLS - 1;
  let codes = new Uint32Array(count), order = new Uint32Array(count);
  let codes2 = new Uint32Array(count), order2 = new Uint32Array(count);
  const digits = 1 << DIGIT;
  // Histograms of all three passes in one go.
  const starts = new Uint32Array(3 * digits);
  for (let i = 0, b = 0; i < count; i++, b += 6) {
    let qx = (((boxes[b] as number) + (boxes[b + 3] as number) - ox) * scale) | 0;
    let qy = (((boxes[b + 1] as number) + (boxes[b + 4] as number) - oy) * scale) | 0;
    let qz = (((boxes[b + 2] as number) + (boxes[b + 5] as number) - oz) * scale) | 0;
    if (qx > last) qx = last;
    if (qy > last) qy = last;
    if (qz > last) qz = last;
    const code = ((spread[qx] as number) << 2) | ((spread[qy] as number) << 1) | (spread[qz] as number);
    codes[i] = code;
    order[i] = i;
    starts[code & last] = (starts[code & last] as number) + 1;
    starts[digits + ((code >>> DIGIT) & last)] = (starts[digits + ((code >>> DIGIT) & last)] as number) + 1;
    starts[2 * digits + (code >>> (2 * DIGIT))] = (starts[2 * digits + (code >>> (2 * DIGIT))] as number) + 1;
  }
  for (let pass = 0; pass < 3; pass++) {
    const base = pass * digits;
    let sum = 0;
    for (let d = 0; d < digits; d++) {
      const n = starts[base + d] as number;
      starts[base + d] = sum;
      sum += n;
    }
    const shift = pass * DIGIT;
    for (let i = 0; i < count; i++) {
      const code = codes[i] as number;
      const slot = base + ((code >>> shift) & last);
      const to = starts[slot] as number;
      starts[slot] = to + 1;
      codes2[to] = code;
      order2[to] = order[i] as number;
    }
    [codes, codes2] = [codes2, codes];
    [order, order2] = [order2, order];
  }
  return { order, codes };
}

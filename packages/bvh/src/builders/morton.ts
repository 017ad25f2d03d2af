import type { Primitives } from './primitives';
import type { Memory } from './scratch';

/** Cells per axis. */
const CELLS = 1024;
/** Bits of one pass of the sort. */
const DIGIT = 10;

/** Numbers of one digit. */
const DIGITS = 1 << DIGIT;

/**
 * Sorts primitives by the Morton codes of their boxes' centres, in cubic cells, by radix. Equal codes keep their order,
 * so the result is the same on all machines.
 */
export class MortonSort {
  /** Primitives, by their Morton codes. */
  order: Uint32Array<ArrayBuffer>;
  /** Morton codes in that order, 30 bits. */
  codes: Uint32Array<ArrayBuffer>;
  #order2: Uint32Array<ArrayBuffer>;
  #codes2: Uint32Array<ArrayBuffer>;
  readonly #primitives: Primitives;
  /** Histograms of the three passes. */
  readonly #starts = new Uint32Array(3 * DIGITS);
  /** Ten bits spread to every third place. */
  readonly #spread = new Uint32Array(CELLS);

  constructor(primitives: Primitives, scratch: Memory) {
    this.#primitives = primitives;
    const { count } = primitives;
    this.order = scratch.uint32(count);
    this.codes = scratch.uint32(count);
    this.#order2 = scratch.uint32(count);
    this.#codes2 = scratch.uint32(count);
    const spread = this.#spread;
    for (let i = 1; i < CELLS; i++) spread[i] = ((spread[i >> 1] as number) << 3) | (i & 1);
  }

  /** Computes the codes of the primitives from `from` up to `to`. */
  encode(from: number, to: number): void {
    const { boxes, bounds } = this.#primitives;
    const DIGITS = 1024,
      DIGIT = 10;
    const { order, codes } = this;
    const spread = this.#spread,
      starts = this.#starts;
    const [x, y, z, x1, y1, z1] = bounds as unknown as [number, number, number, number, number, number];
    const extent = Math.max(x1 - x, y1 - y, z1 - z);
    // Just below the number of cells, so that the largest centre falls into the last.
    const scale = extent > 0 ? (0.4999999 * CELLS) / extent : 0;
    const ox = 2 * x,
      oy = 2 * y,
      oz = 2 * z;
    for (let i = from, b = 6 * from; i < to; i++, b += 6) {
      const qx = (((boxes[b] as number) + (boxes[b + 3] as number) - ox) * scale) | 0;
      const qy = (((boxes[b + 1] as number) + (boxes[b + 4] as number) - oy) * scale) | 0;
      const qz = (((boxes[b + 2] as number) + (boxes[b + 5] as number) - oz) * scale) | 0;
      const code = ((spread[qx] as number) << 2) | ((spread[qy] as number) << 1) | (spread[qz] as number);
      codes[i] = code;
      order[i] = i;
      const second = DIGITS + ((code >>> DIGIT) & 1023),
        third = 2 * DIGITS + (code >>> (2 * DIGIT));
      starts[code & 1023] = (starts[code & 1023] as number) + 1;
      starts[second] = (starts[second] as number) + 1;
      starts[third] = (starts[third] as number) + 1;
    }
  }

  /** Turns the histograms into offsets (prefix sums). */
  begin(): void {
    const starts = this.#starts;
    for (let slot = 0, sum = 0; slot < 3 * DIGITS; slot++) {
      if (slot % DIGITS === 0) sum = 0;
      const n = starts[slot] as number;
      starts[slot] = sum;
      sum += n;
    }
  }

  /** Scatters the entries from `from` up to `to` by one of the three digits, lowest first. */
  scatter(pass: number, from: number, to: number): void {
    const DIGITS = 1024,
      DIGIT = 10;
    const { order, codes } = this;
    const order2 = this.#order2,
      codes2 = this.#codes2,
      starts = this.#starts;
    const base = pass * DIGITS,
      shift = pass * DIGIT;
    for (let i = from; i < to; i++) {
      const code = codes[i] as number;
      const slot = base + ((code >>> shift) & (DIGITS - 1));
      const place = starts[slot] as number;
      starts[slot] = place + 1;
      codes2[place] = code;
      order2[place] = order[i] as number;
    }
  }

  /** Ends a pass. */
  swap(): void {
    [this.codes, this.#codes2] = [this.#codes2, this.codes];
    [this.order, this.#order2] = [this.#order2, this.order];
  }
}

import { putBox } from '../layout';
import { PAIR, pairUp, type Primitives } from './primitives';
import type { Memory } from './scratch';

/** Marks the absence of a second triangle. */
export const NONE = 0xffffffff;

/** Primitives in the order of a space-filling curve. */
export interface Sorted {
  /** Six numbers each: min xyz, max xyz. */
  readonly boxes: Float32Array;
  /** Two numbers each: a triangle, and another or {@link NONE}. */
  readonly names: Uint32Array;
  /** Their places on the curve, rising. */
  readonly codes: Uint32Array;
  readonly count: number;
}

/** Copies primitives into their sorted order, and makes pairs of single triangles that have become neighbours. */
export class Gatherer implements Sorted {
  readonly boxes: Float32Array;
  readonly names: Uint32Array;
  readonly codes: Uint32Array;
  count = 0;
  readonly #primitives: Primitives;
  readonly #order: Uint32Array;
  readonly #pairs: boolean;

  /**
   * @param codes Of the primitives in their order; overwritten.
   */
  constructor(primitives: Primitives, order: Uint32Array, codes: Uint32Array, pairs: boolean, scratch: Memory) {
    this.#pairs = pairs;
    this.#primitives = primitives;
    this.#order = order;
    this.codes = codes;
    this.boxes = scratch.float32(6 * primitives.count);
    this.names = scratch.uint32(2 * primitives.count);
  }

  /** Adds the entries of the order from one to another. Pairs are found within them only. */
  add(from: number, end: number): void {
    const { boxes: unsorted, triangles } = this.#primitives;
    const order = this.#order;
    const { boxes, names, codes } = this;
    let { count } = this;
    // Looked up once: engines do so each time with constants of modules.
    const pair = PAIR,
      none = NONE;
    const pairs = this.#pairs;
    // Whether the last that was written is a single triangle.
    let waiting = false;
    for (let i = from; i < end; i++) {
      const primitive = order[i] as number;
      const b = 6 * primitive;
      const x0 = unsorted[b] as number,
        y0 = unsorted[b + 1] as number,
        z0 = unsorted[b + 2] as number;
      const x1 = unsorted[b + 3] as number,
        y1 = unsorted[b + 4] as number,
        z1 = unsorted[b + 5] as number;
      const name = triangles[primitive] as number;
      const two = name >= pair;
      if (waiting && !two && pairUp(boxes, 6 * count - 6, x0, y0, z0, x1, y1, z1)) {
        names[2 * count - 1] = name;
        waiting = false;
        continue;
      }
      waiting = pairs && !two;
      putBox(boxes, 6 * count, x0, y0, z0, x1, y1, z1);
      names[2 * count] = two ? name - pair : name;
      names[2 * count + 1] = two ? name - pair + 1 : none;
      codes[count++] = codes[i] as number;
    }
    this.count = count;
  }
}

import { BvhError } from '../error';
import { putBox, type TriangleMesh } from '../layout';
import type { Memory } from './scratch';

/**
 * Two triangles become a pair if the surface of their common box is at most this fraction of the sum of their own
 * boxes'. At 1 a pair costs what its halves do; a little less gives better trees at the same speed.
 */
const PAIR_LIMIT = 0.75;

/** Marks a primitive of two triangles, the one named and the next. */
export const PAIR = 0x80000000;

/** Makes the box at `at` that of a pair, with the box given, if these two are to be one. */
export function pairUp(
  boxes: Float32Array,
  at: number,
  x0: number,
  y0: number,
  z0: number,
  x1: number,
  y1: number,
  z1: number,
): boolean {
  const w0 = boxes[at] as number,
    w1 = boxes[at + 1] as number,
    w2 = boxes[at + 2] as number,
    w3 = boxes[at + 3] as number,
    w4 = boxes[at + 4] as number,
    w5 = boxes[at + 5] as number;
  const dx = x1 - x0,
    dy = y1 - y0,
    dz = z1 - z0,
    wx = w3 - w0,
    wy = w4 - w1,
    wz = w5 - w2;
  const u0 = x0 < w0 ? x0 : w0,
    u1 = y0 < w1 ? y0 : w1,
    u2 = z0 < w2 ? z0 : w2;
  const u3 = x1 > w3 ? x1 : w3,
    u4 = y1 > w4 ? y1 : w4,
    u5 = z1 > w5 ? z1 : w5;
  const ux = u3 - u0,
    uy = u4 - u1,
    uz = u5 - u2;
  if (ux * uy + uy * uz + uz * ux > PAIR_LIMIT * (dx * dy + dy * dz + dz * dx + wx * wy + wy * wz + wz * wx))
    return false;
  putBox(boxes, at, u0, u1, u2, u3, u4, u5);
  return true;
}

/** The primitives of a hierarchy: single triangles and pairs of neighbours. */
export interface Primitives {
  /** Six numbers each: min xyz, max xyz. */
  readonly boxes: Float32Array;
  /** First triangle, with {@link PAIR}. */
  readonly triangles: Uint32Array;
  readonly count: number;
  /** Box of all: min xyz, max xyz. */
  readonly bounds: Float64Array;
}

/**
 * Makes primitives of a mesh's triangles. Two triangles that follow each other and fill a common box about as well as
 * their own become one, which halves the work for nearly every mesh: exporters write the two halves of a quad together.
 */
export class PrimitiveMaker implements Primitives {
  readonly boxes: Float32Array<ArrayBuffer>;
  readonly triangles: Uint32Array<ArrayBuffer>;
  readonly bounds = Float64Array.of(Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity);
  count = 0;
  /** Finite triangles. */
  triangleCount = 0;
  readonly #positions: Float32Array;
  readonly #indices: Uint32Array | undefined;
  readonly #pairs: boolean;

  /** @param pairs Whether to pair. */
  constructor({ positions, indices }: TriangleMesh, triangles: number, pairs: boolean, scratch: Memory) {
    this.boxes = scratch.float32(6 * triangles);
    this.triangles = scratch.uint32(triangles);
    this.#positions = positions;
    // For both kinds the same machine code reads the same kind of array.
    this.#indices = indices instanceof Uint16Array ? new Uint32Array(indices) : indices;
    this.#pairs = pairs;
  }

  /**
   * Adds the triangles from one to another. Pairs are found within them only.
   *
   * @throws {BvhError} `bvh/indices` for an index beyond the vertices.
   */
  add(from: number, end: number): void {
    const positions = this.#positions,
      indices = this.#indices;
    const { boxes, triangles, bounds } = this;
    const pairs = this.#pairs;
    const limit = Math.floor(positions.length / 3);
    let { count, triangleCount } = this;
    // The triangle that may become the first of a pair, the last that was written; −2: none.
    let waiting = -2;
    let [bx0, by0, bz0, bx1, by1, bz1] = bounds as unknown as [number, number, number, number, number, number];
    for (let i = from; i < end; i++) {
      let a = 3 * i,
        b = a + 1,
        c = a + 2;
      if (indices) {
        a = indices[a] as number;
        b = indices[b] as number;
        c = indices[c] as number;
        if (a >= limit || b >= limit || c >= limit)
          throw new BvhError('bvh/indices', `Triangle ${i} uses vertex ${Math.max(a, b, c)} of ${limit}.`);
      }
      a *= 3;
      b *= 3;
      c *= 3;
      const ax = positions[a] as number,
        ay = positions[a + 1] as number,
        az = positions[a + 2] as number;
      const bx = positions[b] as number,
        by = positions[b + 1] as number,
        bz = positions[b + 2] as number;
      const cx = positions[c] as number,
        cy = positions[c + 1] as number,
        cz = positions[c + 2] as number;
      // A difference from itself is 0 for finite numbers only.
      const sum = ax + ay + az + bx + by + bz + cx + cy + cz;
      if (sum - sum !== 0) continue;
      triangleCount++;
      const x0 = ax < bx ? (ax < cx ? ax : cx) : bx < cx ? bx : cx;
      const y0 = ay < by ? (ay < cy ? ay : cy) : by < cy ? by : cy;
      const z0 = az < bz ? (az < cz ? az : cz) : bz < cz ? bz : cz;
      const x1 = ax > bx ? (ax > cx ? ax : cx) : bx > cx ? bx : cx;
      const y1 = ay > by ? (ay > cy ? ay : cy) : by > cy ? by : cy;
      const z1 = az > bz ? (az > cz ? az : cz) : bz > cz ? bz : cz;
      if (x0 < bx0) bx0 = x0;
      if (y0 < by0) by0 = y0;
      if (z0 < bz0) bz0 = z0;
      if (x1 > bx1) bx1 = x1;
      if (y1 > by1) by1 = y1;
      if (z1 > bz1) bz1 = z1;
      const at = 6 * count;
      if (pairs && waiting === i - 1 && pairUp(boxes, at - 6, x0, y0, z0, x1, y1, z1)) {
        triangles[count - 1] = waiting + PAIR;
        waiting = -2;
        continue;
      }
      putBox(boxes, at, x0, y0, z0, x1, y1, z1);
      triangles[count++] = waiting = i;
    }
    this.count = count;
    this.triangleCount = triangleCount;
    putBox(bounds, 0, bx0, by0, bz0, bx1, by1, bz1);
  }
}

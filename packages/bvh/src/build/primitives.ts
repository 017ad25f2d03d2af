import { BvhError } from '../error';
import type { TriangleMesh } from '../blas';
import { putBox } from '../layout';
import type { Scratch } from './scratch';

/**
 * Two triangles become a pair if the surface of their common box is at most this part of their own boxes' together. At 1
 * a pair costs what its halves do; a little less gives better trees at the same speed.
 */
const PAIR_LIMIT = 0.75;

/** Marks a primitive of two triangles, the one named and the next. */
export const PAIR = 0x80000000;

/** What a hierarchy is built over: single triangles and pairs of neighbours. */
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
  readonly #mesh: TriangleMesh;
  readonly #pairs: boolean;

  /** @param pairs Whether to pair. */
  constructor(mesh: TriangleMesh, triangles: number, pairs: boolean, scratch: Scratch) {
    this.boxes = scratch.float32(6 * triangles);
    this.triangles = scratch.uint32(triangles);
    this.#mesh = mesh;
    this.#pairs = pairs;
  }

  /**
   * Adds the triangles from one to another. Pairs are found within them only.
   *
   * @throws {BvhError} `bvh/indices` for an index beyond the vertices.
   */
  add(from: number, end: number): void {
    const { positions, indices } = this.#mesh;
    if (indices instanceof Uint16Array) this.#add(positions, Uint32Array.from(indices.subarray(3 * from, 3 * end)), from, end, 3 * from);
    else this.#add(positions, indices, from, end, 0);
  }

  // For both kinds of indices the same machine code reads the same kind of array.
  #add(positions: Float32Array, indices: Uint32Array | undefined, from: number, end: number, shift: number): void {
    const { boxes, triangles, bounds } = this;
    const pairs = this.#pairs;
    const limit = Math.floor(positions.length / 3);
    let { count, triangleCount } = this;
    // The triangle that may become the first of a pair.
    let waiting = -1, waitingArea = 0;
    let wx0 = 0, wy0 = 0, wz0 = 0, wx1 = 0, wy1 = 0, wz1 = 0;
    let bx0 = bounds[0] as number, by0 = bounds[1] as number, bz0 = bounds[2] as number, bx1 = bounds[3] as number, by1 = bounds[4] as number, bz1 = bounds[5] as number;
    for (let i = from; i < end; i++) {
      let a = 3 * i - shift, b = a + 1, c = a + 2;
      if (indices) {
        a = indices[a] as number;
        b = indices[b] as number;
        c = indices[c] as number;
        if (a >= limit || b >= limit || c >= limit) throw new BvhError('bvh/indices', `Triangle ${i} uses vertex ${Math.max(a, b, c)} of ${limit}: every index must be below the number of vertices.`);
      }
      a *= 3;
      b *= 3;
      c *= 3;
      const ax = positions[a] as number, ay = positions[a + 1] as number, az = positions[a + 2] as number;
      const bx = positions[b] as number, by = positions[b + 1] as number, bz = positions[b + 2] as number;
      const cx = positions[c] as number, cy = positions[c + 1] as number, cz = positions[c + 2] as number;
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
      const dx = x1 - x0, dy = y1 - y0, dz = z1 - z0;
      const area = dx * dy + dy * dz + dz * dx;
      if (waiting >= 0) {
        const at = 6 * count;
        const ux0 = x0 < wx0 ? x0 : wx0, uy0 = y0 < wy0 ? y0 : wy0, uz0 = z0 < wz0 ? z0 : wz0;
        const ux1 = x1 > wx1 ? x1 : wx1, uy1 = y1 > wy1 ? y1 : wy1, uz1 = z1 > wz1 ? z1 : wz1;
        const ux = ux1 - ux0, uy = uy1 - uy0, uz = uz1 - uz0;
        if (pairs && waiting === i - 1 && ux * uy + uy * uz + uz * ux <= PAIR_LIMIT * (area + waitingArea)) {
          putBox(boxes, at, ux0, uy0, uz0, ux1, uy1, uz1);
          triangles[count++] = (waiting | PAIR) >>> 0;
          waiting = -1;
          continue;
        }
        putBox(boxes, at, wx0, wy0, wz0, wx1, wy1, wz1);
        triangles[count++] = waiting;
      }
      waiting = i;
      waitingArea = area;
      wx0 = x0;
      wy0 = y0;
      wz0 = z0;
      wx1 = x1;
      wy1 = y1;
      wz1 = z1;
    }
    if (waiting >= 0) {
      putBox(boxes, 6 * count, wx0, wy0, wz0, wx1, wy1, wz1);
      triangles[count++] = waiting;
    }
    this.count = count;
    this.triangleCount = triangleCount;
    putBox(bounds, 0, bx0, by0, bz0, bx1, by1, bz1);
  }
}

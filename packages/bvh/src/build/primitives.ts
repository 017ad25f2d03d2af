import { BvhError } from '../error';
import type { TriangleMesh } from '../blas';
import { putBox } from '../layout';

/**
 * Two triangles become a pair if the surface of their common box is at most this part of their own boxes' together. At 1
 * a pair costs what its halves do; a little less gives better trees at the same speed.
 */
const PAIR_LIMIT = 0.8;

/** Marks a primitive of two triangles, the one named and the next. */
export const PAIR = 0x80000000;

/** What a hierarchy is built over: single triangles and pairs of neighbours. */
export interface Primitives {
  /** Six numbers each: min xyz, max xyz. */
  readonly boxes: Float32Array;
  /** First triangle, with {@link PAIR}. */
  readonly triangles: Uint32Array;
  readonly count: number;
  /** Finite triangles. */
  readonly triangleCount: number;
  /** Box of all: min xyz, max xyz. */
  readonly bounds: Float64Array;
}

/**
 * Makes primitives of a mesh's triangles. Two triangles that follow each other and fill a common box about as well as
 * their own become one, which halves the work for nearly every mesh: exporters write the two halves of a quad together.
 *
 * @param pairs Whether to pair.
 * @throws {BvhError} `bvh/indices` for an index beyond the vertices.
 */
export function makePrimitives(mesh: TriangleMesh, pairs: boolean): Primitives {
  const positions = mesh.positions;
  const indices = mesh.indices instanceof Uint16Array ? Uint32Array.from(mesh.indices) : mesh.indices;
  const end = Math.floor((indices ? indices.length : positions.length / 3) / 3);
  const limit = Math.floor(positions.length / 3);
  const boxes = new Float32Array(end * 6);
  const triangles = new Uint32Array(end);
  let count = 0, triangleCount = 0;
  // The triangle that may become the first of a pair.
  let waiting = -1, waitingArea = 0;
  let wx0 = 0, wy0 = 0, wz0 = 0, wx1 = 0, wy1 = 0, wz1 = 0;
  let bx0 = Infinity, by0 = Infinity, bz0 = Infinity, bx1 = -Infinity, by1 = -Infinity, bz1 = -Infinity;
  for (let i = 0; i < end; i++) {
    let a = 3 * i, b = a + 1, c = a + 2;
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
  return { boxes, triangles, count, triangleCount, bounds: Float64Array.of(bx0, by0, bz0, bx1, by1, bz1) };
}

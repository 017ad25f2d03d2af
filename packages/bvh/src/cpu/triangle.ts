import type { Aabb } from '../layout';

/** How many numbers make a {@link PreparedRay}. */
export const RAY_NUMBERS = 21;

/**
 * A ray in the frame of the test, three numbers each: origin; reciprocal of the direction (finite); two unit vectors
 * perpendicular to the direction, and the direction over its squared length (see the WGSL twin for the method); the
 * origin moved up, for the lower sides of boxes, and down, for their upper sides.
 */
export type PreparedRay = Float64Array;

/**
 * What boxes grow by on each side, as a share of the largest number in a ray's test. Rounding moves the vertices by
 * some 2^-51 of their distance before the edges are tried; a box that is passed by less must not be left out, or a ray
 * gets between two boxes that touch where the triangles in them share an edge.
 */
const SLACK = 2 ** -46;

/** Prepares a ray for a hierarchy of these bounds. */
export function prepareRay(
  ray: PreparedRay,
  origin: ArrayLike<number>,
  direction: ArrayLike<number>,
  { min, max }: Aabb,
): void {
  let dx = direction[0] as number,
    dy = direction[1] as number,
    dz = direction[2] as number;
  const scale = Math.max(Math.abs(dx), Math.abs(dy), Math.abs(dz));
  dx /= scale;
  dy /= scale;
  dz /= scale;
  const length = Math.sqrt(dx * dx + dy * dy + dz * dz);
  const nx = dx / length,
    ny = dy / length,
    nz = dz / length;
  // Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
  const s = nz >= 0 ? 1 : -1;
  const a = -1 / (s + nz);
  const b = nx * ny * a;
  const along = 1 / (length * scale);
  let slack = 0;
  for (let k = 0; k < 3; k++) {
    const o = (ray[k] = origin[k] as number);
    slack = Math.max(slack, Math.abs(o) + Math.max(Math.abs((min[k] as number) - o), Math.abs((max[k] as number) - o)));
  }
  slack *= SLACK;
  ray[3] = 1 / (Math.abs(dx) < 1e-250 ? 1e-250 : dx) / scale;
  ray[4] = 1 / (Math.abs(dy) < 1e-250 ? 1e-250 : dy) / scale;
  ray[5] = 1 / (Math.abs(dz) < 1e-250 ? 1e-250 : dz) / scale;
  ray[6] = 1 + s * nx * nx * a;
  ray[7] = s * b;
  ray[8] = -s * nx;
  ray[9] = b;
  ray[10] = s + ny * ny * a;
  ray[11] = -ny;
  ray[12] = nx * along;
  ray[13] = ny * along;
  ray[14] = nz * along;
  for (let k = 0; k < 3; k++) {
    ray[15 + k] = (ray[k] as number) + slack;
    ray[18 + k] = (ray[k] as number) - slack;
  }
}

/**
 * Watertight ray-triangle test in double precision.
 *
 * @param p Coordinates; the three vertices lie at a, b and c.
 * @param hit Gets t (in units of the ray's direction), the weight of the second vertex, and that of the third.
 */
export function intersectTriangle(
  ray: PreparedRay,
  p: ArrayLike<number>,
  a: number,
  b: number,
  c: number,
  hit: Float64Array,
): boolean {
  const ox = ray[0] as number,
    oy = ray[1] as number,
    oz = ray[2] as number;
  const x0 = ray[6] as number,
    x1 = ray[7] as number,
    x2 = ray[8] as number;
  const y0 = ray[9] as number,
    y1 = ray[10] as number,
    y2 = ray[11] as number;
  const ax = (p[a] as number) - ox,
    ay = (p[a + 1] as number) - oy,
    az = (p[a + 2] as number) - oz;
  const bx = (p[b] as number) - ox,
    by = (p[b + 1] as number) - oy,
    bz = (p[b + 2] as number) - oz;
  const cx = (p[c] as number) - ox,
    cy = (p[c + 1] as number) - oy,
    cz = (p[c + 2] as number) - oz;
  const a0 = x0 * ax + x1 * ay + x2 * az,
    a1 = y0 * ax + y1 * ay + y2 * az;
  const b0 = x0 * bx + x1 * by + x2 * bz,
    b1 = y0 * bx + y1 * by + y2 * bz;
  const c0 = x0 * cx + x1 * cy + x2 * cz,
    c1 = y0 * cx + y1 * cy + y2 * cz;
  const u = a0 * c1 - a1 * c0;
  const v = b0 * a1 - b1 * a0;
  const w = c0 * b1 - c1 * b0;
  // The difference of two rounded products has the sign of the exact one, or is zero; and an edge gives its two
  // triangles numbers that differ in the sign alone: signs alone are watertight.
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
  const determinant = u + v + w;
  if (determinant === 0) return false;
  const z0 = ray[12] as number,
    z1 = ray[13] as number,
    z2 = ray[14] as number;
  hit[0] =
    (u * (z0 * bx + z1 * by + z2 * bz) + v * (z0 * cx + z1 * cy + z2 * cz) + w * (z0 * ax + z1 * ay + z2 * az)) /
    determinant;
  hit[1] = u / determinant;
  hit[2] = v / determinant;
  return true;
}

/** A ray in the frame of the test; see the WGSL twin for the method. */
export interface PreparedRay {
  ox: number;
  oy: number;
  oz: number;
  /** Reciprocal of the direction, finite. */
  ix: number;
  iy: number;
  iz: number;
  /** Two unit vectors perpendicular to the direction, and the direction over its squared length. */
  x: readonly [number, number, number];
  y: readonly [number, number, number];
  z: readonly [number, number, number];
}

/** Prepares a ray; the direction must not be zero. */
export function prepareRay(ox: number, oy: number, oz: number, dx: number, dy: number, dz: number): PreparedRay {
  const safe = (d: number) => 1 / (Math.abs(d) < 1e-20 ? 1e-20 : d);
  const length = Math.hypot(dx, dy, dz);
  const nx = dx / length, ny = dy / length, nz = dz / length;
  const s = nz >= 0 ? 1 : -1;
  const a = -1 / (s + nz);
  const b = nx * ny * a;
  return { ox, oy, oz, ix: safe(dx), iy: safe(dy), iz: safe(dz), x: [1 + s * nx * nx * a, s * b, -s * nx], y: [b, s + ny * ny * a, -ny], z: [nx / length, ny / length, nz / length] };
}

/** Where a ray meets a triangle. */
export interface TriangleHit {
  /** Distance in units of the ray's direction. */
  t: number;
  /** Weight of the second vertex. */
  u: number;
  /** Weight of the third vertex; the first has 1 − u − v. */
  v: number;
}

/**
 * Watertight ray-triangle test in double precision.
 * @param p Coordinates; the three vertices lie at a, b and c.
 */
export function intersectTriangle(ray: PreparedRay, p: ArrayLike<number>, a: number, b: number, c: number, out: TriangleHit): boolean {
  const { ox, oy, oz, x, y, z } = ray;
  const ax = (p[a] as number) - ox, ay = (p[a + 1] as number) - oy, az = (p[a + 2] as number) - oz;
  const bx = (p[b] as number) - ox, by = (p[b + 1] as number) - oy, bz = (p[b + 2] as number) - oz;
  const cx = (p[c] as number) - ox, cy = (p[c + 1] as number) - oy, cz = (p[c + 2] as number) - oz;
  const a0 = x[0] * ax + x[1] * ay + x[2] * az, a1 = y[0] * ax + y[1] * ay + y[2] * az;
  const b0 = x[0] * bx + x[1] * by + x[2] * bz, b1 = y[0] * bx + y[1] * by + y[2] * bz;
  const c0 = x[0] * cx + x[1] * cy + x[2] * cz, c1 = y[0] * cx + y[1] * cy + y[2] * cz;
  const u = a0 * c1 - a1 * c0;
  const v = b0 * a1 - b1 * a0;
  const w = c0 * b1 - c1 * b0;
  const determinant = u + v + w;
  // Without fused operations, u of one triangle is exactly -u of its neighbour: signs alone are watertight.
  if ((Math.min(u, v, w) < 0 && Math.max(u, v, w) > 0) || determinant === 0) return false;
  out.u = u / determinant;
  out.v = v / determinant;
  out.t = (u * (z[0] * bx + z[1] * by + z[2] * bz) + v * (z[0] * cx + z[1] * cy + z[2] * cz) + w * (z[0] * ax + z[1] * ay + z[2] * az)) / determinant;
  return true;
}

/**
 * Brute force by Möller and Trumbore's test (1997) on every triangle, with bounds for its own rounding: `low` is the
 * nearest hit there can be, `high` the nearest that is certain. A right answer lies between them.
 */
export class Oracle {
  low = Infinity;
  high = Infinity;
  readonly #corners: Float64Array;
  /** What lies within this of a degenerate triangle may count as on it. */
  readonly #reach: number;

  /** How well corners are known. */
  readonly #blur: number;

  /**
   * @param corners 9 numbers a triangle.
   * @param blur How well the corners are known, as a share of the largest coordinate: 0, or what transforms have made
   * of rounding.
   */
  constructor(corners: Float64Array, blur = 0) {
    this.#corners = corners;
    const size = corners.reduce((max, x) => Math.max(max, Math.abs(x)), 0);
    this.#reach = 1e-9 * size;
    this.#blur = blur * size;
  }

  /** Sets `low` and `high` for the ray that starts at `rays[at]`: origin, tMin, direction, tMax. */
  ask(rays: ArrayLike<number>, at: number): void {
    const p = this.#corners;
    const ox = rays[at]!,
      oy = rays[at + 1]!,
      oz = rays[at + 2]!,
      tMin = rays[at + 3]!;
    const dx = rays[at + 4]!,
      dy = rays[at + 5]!,
      dz = rays[at + 6]!,
      tMax = rays[at + 7]!;
    const dd = Math.sqrt(dx * dx + dy * dy + dz * dz);
    let low = Infinity,
      high = Infinity;
    for (let i = 0; i < p.length; i += 9) {
      const ax = p[i]!,
        ay = p[i + 1]!,
        az = p[i + 2]!;
      const ex = p[i + 3]! - ax,
        ey = p[i + 4]! - ay,
        ez = p[i + 5]! - az;
      const fx = p[i + 6]! - ax,
        fy = p[i + 7]! - ay,
        fz = p[i + 8]! - az;
      const qx = dy * fz - dz * fy,
        qy = dz * fx - dx * fz,
        qz = dx * fy - dy * fx;
      const det = ex * qx + ey * qy + ez * qz;
      const sx = ox - ax,
        sy = oy - ay,
        sz = oz - az;
      const u = (sx * qx + sy * qy + sz * qz) / det;
      // Most triangles are missed by far, whatever the rounding of a good one.
      if (u < -0.5 || u > 1.5) {
        const ee = ex * ex + ey * ey + ez * ez,
          ff = fx * fx + fy * fy + fz * fz;
        if (Math.abs(det) > 1e-6 * dd * Math.sqrt(ee * ff) && sx * sx + sy * sy + sz * sz < 1e14 * Math.min(ee, ff))
          continue;
      }
      const rx = sy * ez - sz * ey,
        ry = sz * ex - sx * ez,
        rz = sx * ey - sy * ex;
      const v = (dx * rx + dy * ry + dz * rz) / det;
      const t = (fx * rx + fy * ry + fz * rz) / det;
      const e = Math.sqrt(ex * ex + ey * ey + ez * ez),
        f = Math.sqrt(fx * fx + fy * fy + fz * fz),
        s = Math.sqrt(sx * sx + sy * sy + sz * sz);
      // Each is a sum of products of three lengths over the determinant, and so are their errors.
      const unit = 2 ** -49 / Math.abs(det);
      const blur = this.#blur / Math.abs(det);
      const slack = 1e-12 + unit * dd * s * (e + f) + unit * dd * e * f + blur * dd * (e + f);
      if (!(slack < 1e-3)) {
        // Degenerate, or seen edge-on: whatever is near enough may be hit, and nothing must be.
        const near = this.#beside(i, ox, oy, oz, dx, dy, dz, dd);
        if (near < low) low = near;
        continue;
      }
      if (u < -slack || v < -slack || u + v > 1 + slack) continue;
      const error = 1e-12 * Math.abs(t) + unit * e * f * s + blur * e * f;
      if (t + error <= tMin || t - error >= tMax) continue;
      low = Math.min(low, Math.max(t - error, tMin));
      if (u > slack && v > slack && u + v < 1 - slack && t - error > tMin && t + error < tMax)
        high = Math.min(high, t + error);
    }
    this.low = low;
    this.high = high;
  }

  /** Where a ray first comes within reach of a triangle's edges; Infinity if it does not. */
  #beside(i: number, ox: number, oy: number, oz: number, dx: number, dy: number, dz: number, dd: number): number {
    const p = this.#corners;
    let first = Infinity,
      nearest = Infinity;
    const nx = dx / dd,
      ny = dy / dd,
      nz = dz / dd;
    // Vertices as seen along the ray, and distances of the edges from it.
    const across = (k: number): [number, number, number, number] => {
      const x = p[i + 3 * k]! - ox,
        y = p[i + 3 * k + 1]! - oy,
        z = p[i + 3 * k + 2]! - oz;
      const along = x * nx + y * ny + z * nz;
      return [x - along * nx, y - along * ny, z - along * nz, along];
    };
    const corners = [across(0), across(1), across(2)] as const;
    for (let k = 0; k < 3; k++) {
      const a = corners[k]!,
        b = corners[(k + 1) % 3]!;
      const e = [b[0] - a[0], b[1] - a[1], b[2] - a[2]] as const;
      const length = e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
      const s = length > 0 ? Math.min(1, Math.max(0, -(a[0] * e[0] + a[1] * e[1] + a[2] * e[2]) / length)) : 0;
      nearest = Math.min(nearest, Math.hypot(a[0] + s * e[0], a[1] + s * e[1], a[2] + s * e[2]));
      first = Math.min(first, a[3]);
    }
    // The origin may be far away; the reach counts that as well.
    const reach = this.#reach + 1e-9 * (Math.abs(ox) + Math.abs(oy) + Math.abs(oz));
    return nearest <= reach ? (first - reach) / dd : Infinity;
  }
}

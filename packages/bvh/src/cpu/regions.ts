import { BvhError } from '../error';
import { NEAREST_NUMBERS, nearestOnTriangle } from './point-triangle';

/** Of a box: no point of it is in the region. */
export const OUTSIDE = 0;

/** Of a box: it may lie across the region's border. */
export const ACROSS = 1;

/** Of a box: all of it is in the region. */
export const INSIDE = 2;

/**
 * A closed region of space to test triangles against. Implement it for other shapes. Where `box` returns {@link
 * OUTSIDE}, no triangle in the box is tested; where it returns {@link INSIDE}, all of them overlap.
 */
export interface Region {
  /** {@link OUTSIDE}, {@link ACROSS} (also: unknown) or {@link INSIDE}. */
  box(x0: number, y0: number, z0: number, x1: number, y1: number, z1: number): number;
  /** Whether a triangle, its inside included, has a point in common with the region. */
  triangle(
    ax: number,
    ay: number,
    az: number,
    bx: number,
    by: number,
    bz: number,
    cx: number,
    cy: number,
    cz: number,
  ): boolean;
}

/** A {@link Region} that is a row of numbers: many of them make a batch. */
export interface NumberedRegion extends Region {
  /** Numbers a region. */
  readonly numbers: number;
  /** Becomes the region whose numbers start at `values[at]`. */
  set(values: ArrayLike<number>, at: number): void;
}

/** An axis-aligned box. */
export class BoxRegion implements NumberedRegion {
  readonly numbers = 6;
  readonly #b = new Float64Array(6);

  /** @param min xyz of the lower corner. @param max xyz of the upper corner. */
  constructor(min: ArrayLike<number> = [0, 0, 0], max: ArrayLike<number> = min) {
    this.set(
      [min[0] as number, min[1] as number, min[2] as number, max[0] as number, max[1] as number, max[2] as number],
      0,
    );
  }

  /** Min xyz, max xyz. */
  set(values: ArrayLike<number>, at: number): void {
    for (let k = 0; k < 6; k++) this.#b[k] = values[at + k] as number;
  }

  box(x0: number, y0: number, z0: number, x1: number, y1: number, z1: number): number {
    const b = this.#b;
    const bx0 = b[0] as number,
      by0 = b[1] as number,
      bz0 = b[2] as number,
      bx1 = b[3] as number,
      by1 = b[4] as number,
      bz1 = b[5] as number;
    if (!(x0 <= bx1 && x1 >= bx0 && y0 <= by1 && y1 >= by0 && z0 <= bz1 && z1 >= bz0)) return OUTSIDE;
    return x0 >= bx0 && x1 <= bx1 && y0 >= by0 && y1 <= by1 && z0 >= bz0 && z1 <= bz1 ? INSIDE : ACROSS;
  }

  /** By separating axes (Akenine-Möller 2001). */
  triangle(
    ax: number,
    ay: number,
    az: number,
    bx: number,
    by: number,
    bz: number,
    cx: number,
    cy: number,
    cz: number,
  ): boolean {
    const b = this.#b;
    const bx0 = b[0] as number,
      by0 = b[1] as number,
      bz0 = b[2] as number,
      bx1 = b[3] as number,
      by1 = b[4] as number,
      bz1 = b[5] as number;
    // The box's own axes, without any rounding.
    if (
      Math.min(ax, bx, cx) > bx1 ||
      Math.max(ax, bx, cx) < bx0 ||
      Math.min(ay, by, cy) > by1 ||
      Math.max(ay, by, cy) < by0 ||
      Math.min(az, bz, cz) > bz1 ||
      Math.max(az, bz, cz) < bz0
    )
      return false;
    const mx = (bx0 + bx1) / 2,
      my = (by0 + by1) / 2,
      mz = (bz0 + bz1) / 2;
    const hx = (bx1 - bx0) / 2,
      hy = (by1 - by0) / 2,
      hz = (bz1 - bz0) / 2;
    ax -= mx;
    bx -= mx;
    cx -= mx;
    ay -= my;
    by -= my;
    cy -= my;
    az -= mz;
    bz -= mz;
    cz -= mz;
    // One edge after the other, against the box's three axes. Two vertices of an edge fall on one point of such an
    // axis.
    let ex = bx - ax,
      ey = by - ay,
      ez = bz - az;
    if (apart(az * ey - ay * ez, cz * ey - cy * ez, hy * Math.abs(ez) + hz * Math.abs(ey))) return false;
    if (apart(ax * ez - az * ex, cx * ez - cz * ex, hx * Math.abs(ez) + hz * Math.abs(ex))) return false;
    if (apart(ay * ex - ax * ey, cy * ex - cx * ey, hx * Math.abs(ey) + hy * Math.abs(ex))) return false;
    const fx = ex,
      fy = ey,
      fz = ez;
    ex = cx - bx;
    ey = cy - by;
    ez = cz - bz;
    if (apart(bz * ey - by * ez, az * ey - ay * ez, hy * Math.abs(ez) + hz * Math.abs(ey))) return false;
    if (apart(bx * ez - bz * ex, ax * ez - az * ex, hx * Math.abs(ez) + hz * Math.abs(ex))) return false;
    if (apart(by * ex - bx * ey, ay * ex - ax * ey, hx * Math.abs(ey) + hy * Math.abs(ex))) return false;
    const nx = fy * ez - fz * ey,
      ny = fz * ex - fx * ez,
      nz = fx * ey - fy * ex;
    ex = ax - cx;
    ey = ay - cy;
    ez = az - cz;
    if (apart(cz * ey - cy * ez, bz * ey - by * ez, hy * Math.abs(ez) + hz * Math.abs(ey))) return false;
    if (apart(cx * ez - cz * ex, bx * ez - bz * ex, hx * Math.abs(ez) + hz * Math.abs(ex))) return false;
    if (apart(cy * ex - cx * ey, by * ex - bx * ey, hx * Math.abs(ey) + hy * Math.abs(ex))) return false;
    return Math.abs(nx * ax + ny * ay + nz * az) <= hx * Math.abs(nx) + hy * Math.abs(ny) + hz * Math.abs(nz);
  }
}

const apart = (p: number, q: number, radius: number): boolean => Math.min(p, q) > radius || Math.max(p, q) < -radius;

/** A ball. */
export class SphereRegion implements NumberedRegion {
  readonly numbers = 4;
  #x = 0;
  #y = 0;
  #z = 0;
  #squared = 0;
  readonly #nearest = new Float64Array(NEAREST_NUMBERS);

  /** @param center xyz. @param radius Not negative. */
  constructor(center: ArrayLike<number> = [0, 0, 0], radius = 0) {
    this.set([center[0] as number, center[1] as number, center[2] as number, radius], 0);
  }

  /** Center xyz, radius. */
  set(values: ArrayLike<number>, at: number): void {
    this.#x = values[at] as number;
    this.#y = values[at + 1] as number;
    this.#z = values[at + 2] as number;
    this.#squared = (values[at + 3] as number) ** 2;
  }

  box(x0: number, y0: number, z0: number, x1: number, y1: number, z1: number): number {
    const x = this.#x,
      y = this.#y,
      z = this.#z;
    const dx = Math.max(x0 - x, 0, x - x1),
      dy = Math.max(y0 - y, 0, y - y1),
      dz = Math.max(z0 - z, 0, z - z1);
    if (!(dx * dx + dy * dy + dz * dz <= this.#squared)) return OUTSIDE;
    const fx = Math.max(x - x0, x1 - x),
      fy = Math.max(y - y0, y1 - y),
      fz = Math.max(z - z0, z1 - z);
    return fx * fx + fy * fy + fz * fz <= this.#squared ? INSIDE : ACROSS;
  }

  triangle(
    ax: number,
    ay: number,
    az: number,
    bx: number,
    by: number,
    bz: number,
    cx: number,
    cy: number,
    cz: number,
  ): boolean {
    const x = this.#x,
      y = this.#y,
      z = this.#z;
    return (
      nearestOnTriangle(ax - x, ay - y, az - z, bx - x, by - y, bz - z, cx - x, cy - y, cz - z, this.#nearest) <=
      this.#squared
    );
  }
}

/**
 * What lies on the inner side of a few planes: a frustum, an oriented box, a half-space. A plane is four numbers (a, b,
 * c, d); its inner side is where a x + b y + c z + d ≥ 0.
 */
export class ConvexRegion implements NumberedRegion {
  readonly numbers: number;
  readonly #planes: Float64Array;
  /** Corners of the triangle as the planes cut it, and of the next cut. */
  #corners: Float64Array;
  #cut: Float64Array;

  /**
   * @param planes Four numbers each; {@link frustumPlanes} makes those of a camera.
   * @throws {BvhError} `bvh/region` if there are none, or a part of one.
   */
  constructor(planes: ArrayLike<number>) {
    if (planes.length === 0 || planes.length % 4 !== 0)
      throw new BvhError('bvh/region', `The planes have ${planes.length} numbers; they must have four each.`);
    this.numbers = planes.length;
    this.#planes = Float64Array.from(planes);
    // Each plane adds at most one corner.
    this.#corners = new Float64Array(3 * (3 + planes.length / 4));
    this.#cut = new Float64Array(this.#corners.length);
  }

  set(values: ArrayLike<number>, at: number): void {
    for (let k = 0; k < this.numbers; k++) this.#planes[k] = values[at + k] as number;
  }

  box(x0: number, y0: number, z0: number, x1: number, y1: number, z1: number): number {
    const p = this.#planes;
    let where = INSIDE;
    for (let k = 0; k < p.length; k += 4) {
      const a = p[k] as number,
        b = p[k + 1] as number,
        c = p[k + 2] as number,
        d = p[k + 3] as number;
      // Summed up like the corners of triangles: rounding keeps the order of numbers, so no box is farther out than
      // what it holds.
      if (!((a > 0 ? a * x1 : a * x0) + (b > 0 ? b * y1 : b * y0) + (c > 0 ? c * z1 : c * z0) + d >= 0)) return OUTSIDE;
      if (!((a > 0 ? a * x0 : a * x1) + (b > 0 ? b * y0 : b * y1) + (c > 0 ? c * z0 : c * z1) + d >= 0)) where = ACROSS;
    }
    return where;
  }

  /**
   * Cuts the triangle by one plane after the other (Sutherland and Hodgman 1974) and checks whether anything is left.
   */
  triangle(
    ax: number,
    ay: number,
    az: number,
    bx: number,
    by: number,
    bz: number,
    cx: number,
    cy: number,
    cz: number,
  ): boolean {
    const planes = this.#planes;
    let corners = this.#corners,
      cut = this.#cut;
    corners[0] = ax;
    corners[1] = ay;
    corners[2] = az;
    corners[3] = bx;
    corners[4] = by;
    corners[5] = bz;
    corners[6] = cx;
    corners[7] = cy;
    corners[8] = cz;
    let length = 9;
    for (let k = 0; k < planes.length; k += 4) {
      const a = planes[k] as number,
        b = planes[k + 1] as number,
        c = planes[k + 2] as number,
        d = planes[k + 3] as number;
      let kept = 0;
      let px = corners[length - 3] as number,
        py = corners[length - 2] as number,
        pz = corners[length - 1] as number;
      let before = a * px + b * py + c * pz + d;
      for (let i = 0; i < length; i += 3) {
        const x = corners[i] as number,
          y = corners[i + 1] as number,
          z = corners[i + 2] as number;
        const here = a * x + b * y + c * z + d;
        if (before < 0 !== here < 0) {
          const s = before / (before - here);
          cut[kept++] = px + s * (x - px);
          cut[kept++] = py + s * (y - py);
          cut[kept++] = pz + s * (z - pz);
        }
        if (here >= 0) {
          cut[kept++] = x;
          cut[kept++] = y;
          cut[kept++] = z;
        }
        px = x;
        py = y;
        pz = z;
        before = here;
      }
      if (kept === 0) return false;
      length = kept;
      const other = corners;
      corners = cut;
      cut = other;
    }
    return true;
  }
}

/**
 * The six planes of a camera's frustum, for {@link ConvexRegion}: left, right, bottom, top, near, far (Gribb and
 * Hartmann 2001). A far plane at infinity takes everything.
 *
 * @param m View-projection matrix, 16 numbers, column-major, depth 0 to 1 as in WebGPU. Reversed depth only swaps the
 * last two.
 */
export function frustumPlanes(m: ArrayLike<number>): Float64Array<ArrayBuffer> {
  const planes = new Float64Array(24);
  for (let c = 0; c < 4; c++) {
    const x = m[4 * c] as number,
      y = m[4 * c + 1] as number,
      z = m[4 * c + 2] as number,
      w = m[4 * c + 3] as number;
    planes[c] = w + x;
    planes[4 + c] = w - x;
    planes[8 + c] = w + y;
    planes[12 + c] = w - y;
    planes[16 + c] = z;
    planes[20 + c] = w - z;
  }
  return planes;
}

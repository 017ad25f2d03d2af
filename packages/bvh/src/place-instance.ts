import { BvhError } from './error';

import { type Aabb } from './layout';

/** One placement of a BLAS. */
export interface TlasInstance {
  /** Box of the BLAS, in object space. */
  readonly bounds: Aabb;
  /** Object to world, column-major 4×4, affine; may mirror and shear. Units as the positions. */
  readonly transform: ArrayLike<number>;
}

/**
 * Checks that a transform has 16 numbers.
 * @throws {BvhError} `bvh/transform`
 */
export function checkTransform({ transform }: TlasInstance, index: number): void {
  if (transform.length !== 16)
    throw new BvhError('bvh/transform', `Instance ${index} has a transform of ${transform.length} numbers, not 16.`);
}

/**
 * Writes an instance's box in the world, six numbers, and the 12 of its `toObject`.
 *
 * @returns False where nothing can hit it: its rows of `toObject` may be NaN, and the box is undefined.
 */
export function placeInstance(
  { bounds: { min, max }, transform: m }: TlasInstance,
  boxes: Float32Array,
  at: number,
  toObject: Float64Array,
  to: number,
): boolean {
  const exists = invertAffine(m, toObject, to) && (min[0] as number) <= (max[0] as number);
  let sum = 0;
  for (let r = 0; r < 3; r++) {
    let low = m[12 + r] as number,
      high = low;
    // Enlarge by the rounding errors in world and object space, so that no hit near the border is lost.
    let slack = Math.abs(low);
    for (let k = 0; k < 3; k++) {
      const p = (m[4 * k + r] as number) * (min[k] as number),
        q = (m[4 * k + r] as number) * (max[k] as number);
      low += p < q ? p : q;
      high += p < q ? q : p;
      slack += Math.max(Math.abs(p), Math.abs(q));
    }
    slack *= 2 ** -22;
    boxes[at + r] = low - slack;
    boxes[at + 3 + r] = high + slack;
    // Finite only if each part is: six numbers of 3.4e38 at most cannot overflow a double.
    sum += (boxes[at + r] as number) + (boxes[at + 3 + r] as number);
  }
  return exists && Number.isFinite(sum);
}

/** Writes the rows of the inverse of an affine matrix; false (and NaN) where there is none. */
function invertAffine(m: ArrayLike<number>, out: Float64Array, at: number): boolean {
  const a = m[0] as number,
    b = m[4] as number,
    c = m[8] as number,
    x = m[12] as number;
  const d = m[1] as number,
    e = m[5] as number,
    f = m[9] as number,
    y = m[13] as number;
  const g = m[2] as number,
    h = m[6] as number,
    i = m[10] as number,
    z = m[14] as number;
  const p = e * i - f * h,
    q = f * g - d * i,
    r = d * h - e * g;
  const scale = 1 / (a * p + b * q + c * r);
  let finite = putRow(out, at, p * scale, (c * h - b * i) * scale, (b * f - c * e) * scale, x, y, z);
  finite = putRow(out, at + 4, q * scale, (a * i - c * g) * scale, (c * d - a * f) * scale, x, y, z) && finite;
  finite = putRow(out, at + 8, r * scale, (b * g - a * h) * scale, (a * e - b * d) * scale, x, y, z) && finite;
  if (!finite) out.fill(NaN, at, at + 12);
  return finite;
}

/**
 * A row of the inverse with what moves (x, y, z) to the origin. False where a single-precision number cannot hold it.
 */
function putRow(
  out: Float64Array,
  at: number,
  p: number,
  q: number,
  r: number,
  x: number,
  y: number,
  z: number,
): boolean {
  const w = -(p * x + q * y + r * z);
  out[at] = p;
  out[at + 1] = q;
  out[at + 2] = r;
  out[at + 3] = w;
  return Number.isFinite(Math.fround(p + q + r + w));
}

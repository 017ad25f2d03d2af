import type { Matrix } from './types';

/** 16 numbers, column-major. */
export type Mat4 = Float64Array<ArrayBuffer>;

export const numbersFrom = ({ elements }: Matrix): Mat4 => Float64Array.from(elements);

export function multiply(a: ArrayLike<number>, b: ArrayLike<number>): Mat4 {
  const out = new Float64Array(16);
  for (let c = 0; c < 4; c++) for (let r = 0; r < 4; r++) {
    let sum = 0;
    for (let k = 0; k < 4; k++) sum += (a[4 * k + r] as number) * (b[4 * c + k] as number);
    out[4 * c + r] = sum;
  }
  return out;
}

/** Transforms the point at `at`, in place. */
export function transformPoint(m: ArrayLike<number>, points: Float32Array, at: number): void {
  const [x, y, z] = [points[at] as number, points[at + 1] as number, points[at + 2] as number];
  for (let r = 0; r < 3; r++) points[at + r] = (m[r] as number) * x + (m[4 + r] as number) * y + (m[8 + r] as number) * z + (m[12 + r] as number);
}

/** Transforms the normal at `at` by the cofactors of the upper left 3 × 3, in place; its length is not kept. */
export function transformNormal(m: ArrayLike<number>, normals: Float32Array, at: number): void {
  const [x, y, z] = [normals[at] as number, normals[at + 1] as number, normals[at + 2] as number];
  const e = (r: number, c: number) => m[4 * c + r] as number;
  for (let r = 0; r < 3; r++) {
    const [r1, r2] = [(r + 1) % 3, (r + 2) % 3];
    const cofactor = (c: number) => {
      const [c1, c2] = [(c + 1) % 3, (c + 2) % 3];
      return e(r1, c1) * e(r2, c2) - e(r1, c2) * e(r2, c1);
    };
    normals[at + r] = cofactor(0) * x + cofactor(1) * y + cofactor(2) * z;
  }
}

/** Column `c` of the rotation, as a unit vector. */
export function axisOf(m: ArrayLike<number>, c: number): [number, number, number] {
  const v: [number, number, number] = [m[4 * c] as number, m[4 * c + 1] as number, m[4 * c + 2] as number];
  const length = Math.hypot(...v) || 1;
  return [v[0] / length, v[1] / length, v[2] / length];
}

export const positionOf = (m: ArrayLike<number>): [number, number, number] => [m[12] as number, m[13] as number, m[14] as number];

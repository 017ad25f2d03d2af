import type { Rgb } from './names';

/** Nine numbers, column-major. */
export type Matrix3 = readonly [number, number, number, number, number, number, number, number, number];

/** m · v */
export function transform(m: Matrix3, [x, y, z]: Rgb): [number, number, number] {
  return [m[0] * x + m[3] * y + m[6] * z, m[1] * x + m[4] * y + m[7] * z, m[2] * x + m[5] * y + m[8] * z];
}

/** The matrix as a WGSL expression, so that both twins read one table. */
export function wgslMatrix(m: Matrix3): string {
  return `mat3x3f(${m.join(', ')})`;
}

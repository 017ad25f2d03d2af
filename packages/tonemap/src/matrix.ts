import { transformMat3 } from 'gl-matrix/esm/vec3.js';
import type { Rgb } from './names';

/** Nine numbers, column-major. */
export type Matrix3 = readonly [number, number, number, number, number, number, number, number, number];

/** m · v */
export const transform = (m: Matrix3, v: Rgb): [number, number, number] => transformMat3([0, 0, 0], v, m);

/** The matrix as a WGSL expression, so that both twins read one table. */
export function wgslMatrix(m: Matrix3): string {
  return `mat3x3f(${m.join(', ')})`;
}

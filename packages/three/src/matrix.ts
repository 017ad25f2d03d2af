import { adjoint, fromMat4, transpose } from 'gl-matrix/esm/mat3.js';
import { add, transformMat3 } from 'gl-matrix/esm/vec3.js';
import type { Matrix } from './types';

/** 16 numbers, column-major. */
export type Mat4 = Float64Array<ArrayBuffer>;

export const numbersFrom = ({ elements }: Matrix): Mat4 => Float64Array.from(elements);

/** The vector at `at` through a 3 × 3 matrix, as three numbers. */
function turned(vectors: Float32Array, at: number, matrix: ArrayLike<number>): [number, number, number] {
  const vector: [number, number, number] = [
    vectors[at] as number,
    vectors[at + 1] as number,
    vectors[at + 2] as number,
  ];
  return transformMat3(vector, vector, matrix);
}

/** Transforms the point at `at`, in place. */
export function transformPoint(m: ArrayLike<number>, points: Float32Array, at: number): void {
  const point = turned(points, at, fromMat4([], m));
  points.set(add(point, point, positionOf(m)), at);
}

/** Transforms the normal at `at` by the cofactors of the upper left 3 × 3, in place; its length is not kept. */
export function transformNormal(m: ArrayLike<number>, normals: Float32Array, at: number): void {
  const cofactors: number[] = fromMat4([], m);
  normals.set(turned(normals, at, transpose(cofactors, adjoint(cofactors, cofactors))), at);
}

/** Column `c` of the rotation, as a unit vector. */
export function axisOf(m: ArrayLike<number>, c: number): [number, number, number] {
  const v: [number, number, number] = [m[4 * c] as number, m[4 * c + 1] as number, m[4 * c + 2] as number];
  const length = Math.hypot(...v) || 1;
  return [v[0] / length, v[1] / length, v[2] / length];
}

export const positionOf = (m: ArrayLike<number>): [number, number, number] => [
  m[12] as number,
  m[13] as number,
  m[14] as number,
];

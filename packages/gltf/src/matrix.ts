/** A 4 × 4 matrix, column-major, in double precision: what gl-matrix writes into. */
export type Matrix = number[];

export const identity = (): Matrix => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

export const isFinite4x4 = (m: Matrix): boolean => m.every(Number.isFinite);

/** Three components. */
export type Vector = readonly [x: number, y: number, z: number];

/** The cross product of two vectors of three components. */
export const cross = (a: readonly number[], b: readonly number[]): Vector => [
  a[1]! * b[2]! - a[2]! * b[1]!,
  a[2]! * b[0]! - a[0]! * b[2]!,
  a[0]! * b[1]! - a[1]! * b[0]!,
];

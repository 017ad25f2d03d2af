/** A 4 × 4 matrix, column-major. */
export type Matrix = readonly number[];

/** The product a·b: b is applied first. */
export function multiply(a: Matrix, b: Matrix): Matrix {
  const result: number[] = [];
  for (let column = 0; column < 4; column++)
    for (let row = 0; row < 4; row++)
      result.push([0, 1, 2, 3].reduce((sum, k) => sum + a[4 * k + row]! * b[4 * column + k]!, 0));
  return result;
}

/** Moves by metres. */
export const translation = (x: number, y: number, z: number): Matrix => [
  1,
  0,
  0,
  0,
  0,
  1,
  0,
  0,
  0,
  0,
  1,
  0,
  x,
  y,
  z,
  1,
];

/** Scales all axes alike. */
export const scaling = (s: number): Matrix => [s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, 0, 0, 0, 1];

/** Rotates about an axis, degrees, counter-clockwise seen against it. */
export function rotation(axis: 'x' | 'y' | 'z', degrees: number): Matrix {
  const [c, s] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
  if (axis === 'x') return [1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, 0, 0, 0, 1];
  if (axis === 'y') return [c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0, 0, 0, 1];
  return [c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
}

/** From z up, as shapes are built, to y up: +z becomes +y, +y becomes −z. */
export const UPRIGHT: Matrix = [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1];

/** A 4 × 4 matrix, column-major, in double precision. */
export type Matrix = number[];

export const identity = (): Matrix => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

export const isFinite4x4 = (m: Matrix): boolean => m.every(Number.isFinite);

/** The matrix a · b: b first, then a. */
export function multiply(a: ArrayLike<number>, b: ArrayLike<number>): Matrix {
  const product: Matrix = new Array<number>(16);
  for (let column = 0; column < 16; column += 4) {
    for (let row = 0; row < 4; row++) {
      let sum = 0;
      for (let k = 0; k < 4; k++) sum += (a[4 * k + row] as number) * (b[column + k] as number);
      product[column + row] = sum;
    }
  }
  return product;
}

/** Scaled, then turned by the unit quaternion xyzw, then moved. */
export function compose(t: ArrayLike<number>, r: ArrayLike<number>, s: ArrayLike<number>): Matrix {
  const [x, y, z, w] = [r[0], r[1], r[2], r[3]] as [number, number, number, number];
  const [sx, sy, sz] = [s[0], s[1], s[2]] as [number, number, number];
  return [
    (1 - 2 * (y * y + z * z)) * sx, 2 * (x * y + z * w) * sx, 2 * (x * z - y * w) * sx, 0,
    2 * (x * y - z * w) * sy, (1 - 2 * (x * x + z * z)) * sy, 2 * (y * z + x * w) * sy, 0,
    2 * (x * z + y * w) * sz, 2 * (y * z - x * w) * sz, (1 - 2 * (x * x + y * y)) * sz, 0,
    t[0] as number, t[1] as number, t[2] as number, 1,
  ];
}

/** Determinant of the upper 3×3 part of a column-major 4×4 matrix. */
export function determinant3(m: ArrayLike<number>): number {
  const [a, b, c] = [m[0] as number, m[1] as number, m[2] as number];
  const [d, e, f] = [m[4] as number, m[5] as number, m[6] as number];
  const [g, h, i] = [m[8] as number, m[9] as number, m[10] as number];
  return a * (e * i - f * h) - d * (b * i - c * h) + g * (b * f - c * e);
}

/** A point through a column-major affine matrix. */
export function transformPoint(
  m: ArrayLike<number>,
  x: number,
  y: number,
  z: number,
  out: Float64Array | number[],
  at = 0,
): void {
  for (let r = 0; r < 3; r++)
    out[at + r] = (m[r] as number) * x + (m[4 + r] as number) * y + (m[8 + r] as number) * z + (m[12 + r] as number);
}

/**
 * Inverts a `toObject` of a TLAS: writes the rows of the 3×4 matrix from object to world space.
 *
 * @param at Where the 12 numbers of `toObject` begin.
 */
export function toWorld(m: ArrayLike<number>, at: number, out: Float64Array): void {
  const a = m[at] as number,
    b = m[at + 1] as number,
    c = m[at + 2] as number,
    x = m[at + 3] as number;
  const d = m[at + 4] as number,
    e = m[at + 5] as number,
    f = m[at + 6] as number,
    y = m[at + 7] as number;
  const g = m[at + 8] as number,
    h = m[at + 9] as number,
    i = m[at + 10] as number,
    z = m[at + 11] as number;
  const scale = 1 / (a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g));
  out[0] = (e * i - f * h) * scale;
  out[1] = (c * h - b * i) * scale;
  out[2] = (b * f - c * e) * scale;
  out[4] = (f * g - d * i) * scale;
  out[5] = (a * i - c * g) * scale;
  out[6] = (c * d - a * f) * scale;
  out[8] = (d * h - e * g) * scale;
  out[9] = (b * g - a * h) * scale;
  out[10] = (a * e - b * d) * scale;
  for (let r = 0; r < 12; r += 4)
    out[r + 3] = -((out[r] as number) * x + (out[r + 1] as number) * y + (out[r + 2] as number) * z);
}

/**
 * Maximum stretch of the linear part of a 3×4 matrix: its largest singular value, from the eigenvalues of
 * MᵀM in closed form (Smith 1961), rounded up.
 */
export function largestStretch(m: ArrayLike<number>, at: number): number {
  const dot = (p: number, q: number) =>
    (m[at + p] as number) * (m[at + q] as number) +
    (m[at + 4 + p] as number) * (m[at + 4 + q] as number) +
    (m[at + 8 + p] as number) * (m[at + 8 + q] as number);
  const xx = dot(0, 0),
    yy = dot(1, 1),
    zz = dot(2, 2),
    xy = dot(0, 1),
    xz = dot(0, 2),
    yz = dot(1, 2);
  const mean = (xx + yy + zz) / 3;
  const x = xx - mean,
    y = yy - mean,
    z = zz - mean;
  const p = Math.sqrt((x * x + y * y + z * z + 2 * (xy * xy + xz * xz + yz * yz)) / 6);
  // Half the determinant of the matrix whose eigenvalues are shifted and scaled to lie within −2 and 2.
  const half =
    p > 0 ? (x * (y * z - yz * yz) - xy * (xy * z - yz * xz) + xz * (xy * yz - y * xz)) / (2 * p * p * p) : 0;
  const largest = mean + 2 * p * Math.cos(Math.acos(Math.min(1, Math.max(-1, half))) / 3);
  return Math.sqrt(largest) * (1 + 1e-9);
}

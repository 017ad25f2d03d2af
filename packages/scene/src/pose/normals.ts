/**
 * Normalizes the first three numbers of every entry, in place: quantised vectors and those of some exporters are not
 * unit vectors.
 * @returns False if a vector has length 0 or is not finite.
 */
export function makeUnit(vectors: Float32Array, stride: number): boolean {
  let good = true;
  for (let at = 0; at < vectors.length; at += stride) {
    const x = vectors[at] as number,
      y = vectors[at + 1] as number,
      z = vectors[at + 2] as number;
    const square = x * x + y * y + z * z;
    // Nearly all are unit vectors already, and Math.hypot is ten times slower.
    if (Math.abs(square - 1) <= 2e-6) continue;
    const length = square > 1e-20 && square < 1e20 ? Math.sqrt(square) : Math.hypot(x, y, z);
    if (!(length > 1e-12)) good = false;
    else {
      vectors[at] = x / length;
      vectors[at + 1] = y / length;
      vectors[at + 2] = z / length;
    }
  }
  return good;
}

/** Unit normals. One of length 0 is computed from the triangles at its vertex, weighted by their areas. */
export function unitNormals(
  normals: Float32Array<ArrayBuffer>,
  positions: Float32Array,
  indices: Uint32Array,
  warn: (message: string) => void,
): Float32Array<ArrayBuffer> {
  if (makeUnit(normals, 3)) return normals;
  const sums = new Float64Array(normals.length);
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [3 * (indices[i] as number), 3 * (indices[i + 1] as number), 3 * (indices[i + 2] as number)];
    const p = (v: number, k: number) => positions[v + k] as number;
    const [ux, uy, uz] = [p(b, 0) - p(a, 0), p(b, 1) - p(a, 1), p(b, 2) - p(a, 2)];
    const [vx, vy, vz] = [p(c, 0) - p(a, 0), p(c, 1) - p(a, 1), p(c, 2) - p(a, 2)];
    const cross = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const v of [a, b, c]) for (let k = 0; k < 3; k++) sums[v + k] = (sums[v + k] as number) + (cross[k] as number);
  }
  let made = 0;
  for (let at = 0; at < normals.length; at += 3) {
    if (Math.hypot(normals[at] as number, normals[at + 1] as number, normals[at + 2] as number) > 1e-12) continue;
    const length = Math.hypot(sums[at] as number, sums[at + 1] as number, sums[at + 2] as number);
    // A vertex of degenerate triangles only is never visible: any direction works.
    for (let k = 0; k < 3; k++) normals[at + k] = length > 0 ? (sums[at + k] as number) / length : k === 2 ? 1 : 0;
    made++;
  }
  warn(`${made} normals have length 0; they are computed from the triangles.`);
  return normals;
}

/**
 * Reverses the winding of all triangles, in place, if the vertex normals of each point to its back: some exporters
 * mirror a mesh without reversing its triangles. The normals are kept, since they define the shading that the author
 * saw. The search stops at the first triangle that agrees with its normals, usually the first of all.
 * @returns Whether the triangles were reversed.
 */
export function windByNormals(indices: Uint32Array, positions: Float32Array, normals: Float32Array): boolean {
  let against = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const a = 3 * (indices[i] as number),
      b = 3 * (indices[i + 1] as number),
      c = 3 * (indices[i + 2] as number);
    const p = (v: number, k: number) => positions[v + k] as number,
      n = (k: number) => (normals[a + k] as number) + (normals[b + k] as number) + (normals[c + k] as number);
    const ux = p(b, 0) - p(a, 0),
      uy = p(b, 1) - p(a, 1),
      uz = p(b, 2) - p(a, 2);
    const vx = p(c, 0) - p(a, 0),
      vy = p(c, 1) - p(a, 1),
      vz = p(c, 2) - p(a, 2);
    const along = (uy * vz - uz * vy) * n(0) + (uz * vx - ux * vz) * n(1) + (ux * vy - uy * vx) * n(2);
    if (along > 0) return false;
    if (along < 0) against++;
  }
  if (against === 0) return false;
  for (let i = 0; i < indices.length; i += 3)
    [indices[i + 1], indices[i + 2]] = [indices[i + 2] as number, indices[i + 1] as number];
  return true;
}

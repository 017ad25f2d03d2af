import type { Mesh } from '@glanz/scene';

/** Cosine of the largest angle between a triangle and the normals at its corners: 60°. */
const LEAST_COSINE = 0.5;

/**
 * A mesh whose normals fit its triangles. Simplified triangles can lie far off the surface that their corners' normals are
 * of, and a path tracer then sees the light come from behind: such corners get the triangle's own normal, at a vertex of their
 * own.
 */
export function withSoundNormals(mesh: Mesh): Mesh {
  const { positions: P, normals: N, indices } = mesh;
  if (!N) return mesh;
  // Normals of vertices that are added, and the vertices whose places they share.
  const added: number[] = [], sources: number[] = [];
  const fitting = indices.slice();
  for (let t = 0; t < indices.length; t += 3) {
    const [a, b, c] = [indices[t], indices[t + 1], indices[t + 2]].map((v) => 3 * (v as number)) as [number, number, number];
    const u = [0, 1, 2].map((k) => (P[b + k] as number) - (P[a + k] as number)) as [number, number, number];
    const v = [0, 1, 2].map((k) => (P[c + k] as number) - (P[a + k] as number)) as [number, number, number];
    const cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]] as const;
    const length = Math.hypot(...cross);
    if (!(length > 0)) continue;
    const normal = [cross[0] / length, cross[1] / length, cross[2] / length] as const;
    for (let corner = t; corner < t + 3; corner++) {
      const from = 3 * (indices[corner] as number);
      const cosine = normal[0] * (N[from] as number) + normal[1] * (N[from + 1] as number) + normal[2] * (N[from + 2] as number);
      if (cosine >= LEAST_COSINE) continue;
      fitting[corner] = P.length / 3 + sources.push(from) - 1;
      added.push(...normal);
    }
  }
  if (sources.length === 0) return mesh;
  const positions = new Float32Array(P.length + added.length), normals = new Float32Array(N.length + added.length);
  positions.set(P);
  normals.set(N);
  normals.set(added, N.length);
  sources.forEach((from, i) => positions.set(P.subarray(from, from + 3), P.length + 3 * i));
  return { name: mesh.name, positions, normals, indices: fitting };
}

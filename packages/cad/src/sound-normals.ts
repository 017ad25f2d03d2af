import type { Mesh } from '@glanz/scene';
import { cross, dot, subtract } from 'gl-matrix/esm/vec3.js';

/** Cosine of the largest angle between a triangle and the normals at its corners: 60°. */
const MIN_COSINE = 0.5;

/**
 * A mesh whose normals fit its triangles. Simplified triangles can lie far off the surface that their corners' normals
 * are of, and a path tracer then sees the light come from behind: such corners get the triangle's own normal, at a
 * vertex of their own.
 */
export function withSoundNormals(mesh: Mesh): Mesh {
  const { positions: P, normals: N, indices } = mesh;
  if (!N) return mesh;
  // Normals of vertices that are added, and the vertices whose places they share.
  const added: number[] = [],
    sources: number[] = [];
  const fitting = indices.slice();
  for (let t = 0; t < indices.length; t += 3) {
    const [a, b, c] = [indices[t], indices[t + 1], indices[t + 2]].map((v) => 3 * (v as number)) as [
      number,
      number,
      number,
    ];
    const corner0 = P.subarray(a);
    const across = cross(
      [0, 0, 0],
      subtract([0, 0, 0], P.subarray(b), corner0),
      subtract([0, 0, 0], P.subarray(c), corner0),
    );
    const length = Math.hypot(...across);
    if (!(length > 0)) continue;
    const normal = [across[0] / length, across[1] / length, across[2] / length] as const;
    for (let corner = t; corner < t + 3; corner++) {
      const from = 3 * (indices[corner] as number);
      if (dot(normal, N.subarray(from)) >= MIN_COSINE) continue;
      fitting[corner] = P.length / 3 + sources.push(from) - 1;
      added.push(...normal);
    }
  }
  if (sources.length === 0) return mesh;
  const positions = new Float32Array(P.length + added.length),
    normals = new Float32Array(N.length + added.length);
  positions.set(P);
  normals.set(N);
  normals.set(added, N.length);
  sources.forEach((from, i) => positions.set(P.subarray(from, from + 3), P.length + 3 * i));
  return { name: mesh.name, positions, normals, indices: fitting };
}

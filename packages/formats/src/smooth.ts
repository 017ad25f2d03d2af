import type { Mesh } from '@glanz/scene';
import { add, cross, subtract } from 'gl-matrix/esm/vec3.js';

/**
 * Normals for a mesh that has none: triangles of the same smoothing group share them where they share a place, weighted
 * by area; those of group 0 stay flat. Vertices that need several normals are doubled.
 *
 * @param groups One for each triangle.
 */
export function smoothNormals(mesh: Mesh, groups: readonly number[]): Mesh {
  const { positions, indices } = mesh;
  const place = (vertex: number) =>
    `${positions[3 * vertex]} ${positions[3 * vertex + 1]} ${positions[3 * vertex + 2]}`;
  const sums = new Map<string, [number, number, number]>();
  const triangles = indices.length / 3;
  const faces = Array.from({ length: triangles }, (_, t): [number, number, number] => {
    const [a, b, c] = [0, 1, 2].map((corner) => positions.subarray(3 * (indices[3 * t + corner] as number))) as [
      Float32Array,
      Float32Array,
      Float32Array,
    ];
    const normal = subtract([0, 0, 0], b, a);
    return cross(normal, normal, subtract([0, 0, 0], c, a));
  });
  const keyOf = (corner: number): string => {
    const t = Math.floor(corner / 3);
    return groups[t] ? `${groups[t]}|${place(indices[corner] as number)}` : `flat ${t}`;
  };
  for (let corner = 0; corner < indices.length; corner++) {
    const face = faces[Math.floor(corner / 3)] as [number, number, number];
    const sum = sums.get(keyOf(corner)) ?? [0, 0, 0];
    sums.set(keyOf(corner), add([0, 0, 0], sum, face));
  }
  const made = new Map<string, number>();
  const source: number[] = [],
    normals: number[] = [];
  const remapped = indices.map((vertex, corner) => {
    const key = keyOf(corner);
    const whole = `${vertex}|${key}`;
    const known = made.get(whole);
    if (known !== undefined) return known;
    const sum = sums.get(key) as [number, number, number];
    const length = Math.hypot(...sum);
    // A triangle without area is never seen; any direction will do.
    normals.push(...(length > 0 ? sum.map((x) => x / length) : [0, 0, 1]));
    made.set(whole, source.push(vertex) - 1);
    return source.length - 1;
  });
  const gather = (values: Float32Array<ArrayBuffer>, stride: number) =>
    Float32Array.from(
      source.flatMap((vertex) => Array.from(values.subarray(stride * vertex, stride * vertex + stride))),
    );
  const result: Mesh = {
    ...mesh,
    indices: remapped,
    positions: gather(positions, 3),
    normals: Float32Array.from(normals),
  };
  if (mesh.uvs) result.uvs = mesh.uvs.map((uv) => gather(uv, 2));
  if (mesh.colors) result.colors = gather(mesh.colors, 4);
  return result;
}

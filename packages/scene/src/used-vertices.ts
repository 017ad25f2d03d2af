import type { Mesh } from './mesh';

/** 1 for each vertex that a triangle uses. Vertices are shared by six triangles or so: looking at each once is several times as fast. */
export function usedVertices({ positions, indices }: Mesh): Uint8Array {
  const used = new Uint8Array(positions.length / 3);
  for (let i = 0; i < indices.length; i++) used[indices[i] as number] = 1;
  return used;
}

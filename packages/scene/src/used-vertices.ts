import type { Mesh } from './mesh';
import { STEP, type Steps } from './slices';

/** 1 for each vertex that a triangle uses. Vertices are shared by six triangles or so: looking at each once is several times as fast. */
export function* usedVertices({ positions, indices }: Mesh): Steps<Uint8Array> {
  const used = new Uint8Array(positions.length / 3);
  for (let from = 0; from < indices.length; from += STEP) {
    mark(used, indices, from, Math.min(indices.length, from + STEP));
    yield;
  }
  return used;
}

function mark(used: Uint8Array, indices: Uint32Array, from: number, to: number): void {
  for (let i = from; i < to; i++) used[indices[i] as number] = 1;
}

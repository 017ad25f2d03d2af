import type { Mesh } from './mesh';
import { STEP, type Steps } from './slices';

/** Number of consecutive vertices that share a box. Neighbours in a mesh's list are mostly neighbours in space. */
export const RUN = 64;

/** The vertices of a mesh that triangles use. */
export interface UsedVertices {
  /** 1 for each vertex in use. */
  readonly used: Uint8Array;
  /** The first vertex in use; −1 if there are none. */
  readonly first: number;
  /**
   * Bounds of the used vertices of each run of {@link RUN} vertices, six numbers each: min xyz, max xyz. The last box
   * bounds all.
   */
  readonly boxes: Float32Array;
}

/**
 * Finds the vertices that triangles use. About six triangles share a vertex: visiting each once is several times
 * as fast.
 */
export function* usedVertices({ positions, indices }: Mesh): Steps<UsedVertices> {
  const vertices = Math.floor(positions.length / 3);
  const used = new Uint8Array(vertices);
  for (let from = 0; from < indices.length; from += STEP) {
    mark(used, indices, from, Math.min(indices.length, from + STEP));
    yield;
  }
  const boxes = new Float32Array(6 * (Math.ceil(vertices / RUN) + 1));
  for (let at = 0; at < boxes.length; at += 6) boxes.fill(Infinity, at, at + 3).fill(-Infinity, at + 3, at + 6);
  for (let from = 0; from < vertices; from += STEP) {
    enclose(boxes, used, positions, from, Math.min(vertices, from + STEP));
    yield;
  }
  return { used, first: used.indexOf(1), boxes };
}

function mark(used: Uint8Array, indices: Uint32Array, from: number, to: number): void {
  for (let i = from; i < to; i++) used[indices[i] as number] = 1;
}

function enclose(boxes: Float32Array, used: Uint8Array, positions: Float32Array, from: number, to: number): void {
  const all = boxes.length - 6;
  for (let i = from; i < to; i++) {
    if (used[i] === 0) continue;
    const box = 6 * Math.floor(i / RUN);
    for (let k = 0; k < 3; k++) {
      const x = positions[3 * i + k] as number;
      if (x < (boxes[box + k] as number)) boxes[box + k] = x;
      if (x > (boxes[box + 3 + k] as number)) boxes[box + 3 + k] = x;
      if (x < (boxes[all + k] as number)) boxes[all + k] = x;
      if (x > (boxes[all + 3 + k] as number)) boxes[all + 3 + k] = x;
    }
  }
}

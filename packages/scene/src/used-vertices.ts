import type { Mesh } from './mesh';
import { STEP, type Steps } from './slices';

/** Number of consecutive vertices that share a box. Neighbours in a mesh's list are mostly neighbours in space. */
export const RUN = 64;

/** The vertices of a mesh that triangles use. */
export interface UsedVertices {
  /** 1 for each vertex in use. */
  readonly used: Uint8Array;
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
  return { used, boxes };
}

function mark(used: Uint8Array, indices: Uint32Array, from: number, to: number): void {
  for (let i = from; i < to; i++) used[indices[i] as number] = 1;
}

/** Bounds the runs of the vertices from `from`, a multiple of {@link RUN}, up to `to`. No lists in the inner loop. */
function enclose(boxes: Float32Array, used: Uint8Array, positions: Float32Array, from: number, to: number): void {
  const all = boxes.length - 6;
  for (let first = from; first < to; first += RUN) {
    const end = Math.min(to, first + RUN);
    let x0 = Infinity,
      y0 = Infinity,
      z0 = Infinity,
      x1 = -Infinity,
      y1 = -Infinity,
      z1 = -Infinity;
    for (let i = first, v = 3 * first; i < end; i++, v += 3) {
      if (used[i] === 0) continue;
      const x = positions[v] as number,
        y = positions[v + 1] as number,
        z = positions[v + 2] as number;
      if (x < x0) x0 = x;
      if (x > x1) x1 = x;
      if (y < y0) y0 = y;
      if (y > y1) y1 = y;
      if (z < z0) z0 = z;
      if (z > z1) z1 = z;
    }
    widen(boxes, (6 * first) / RUN, x0, y0, z0, x1, y1, z1);
    widen(boxes, all, x0, y0, z0, x1, y1, z1);
  }
}

function widen(
  boxes: Float32Array,
  at: number,
  x0: number,
  y0: number,
  z0: number,
  x1: number,
  y1: number,
  z1: number,
): void {
  boxes[at] = Math.min(boxes[at] as number, x0);
  boxes[at + 1] = Math.min(boxes[at + 1] as number, y0);
  boxes[at + 2] = Math.min(boxes[at + 2] as number, z0);
  boxes[at + 3] = Math.max(boxes[at + 3] as number, x1);
  boxes[at + 4] = Math.max(boxes[at + 4] as number, y1);
  boxes[at + 5] = Math.max(boxes[at + 5] as number, z1);
}

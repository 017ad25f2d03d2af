import type { Memory } from './scratch';
import type { Sorted } from './gather';

/** Cells of neighbouring primitives, over which the top levels of a tree are built. */
export interface Clusters {
  readonly primitives: Sorted;
  /** First primitive of each cluster, and one entry more for the end. */
  readonly starts: Uint32Array;
  readonly count: number;
  /** Boxes of the clusters, set with the trees inside, as are the following. */
  readonly boxes: Float32Array;
  /** Triangles of each cluster. */
  readonly weights: Uint32Array;
  /** References to the trees inside. */
  readonly references: Uint32Array;
}

/**
 * Cuts primitives sorted by their Morton codes into octree cells of at most `size` primitives. Cells of equal codes are
 * cut by count.
 *
 * @param ends Ends of the ranges still to cut, the next one last.
 * @param first Where the next one begins.
 * @param limit The border of cells to stop at.
 * @returns Number of cells; their starts are written, and one entry more for the end.
 */
export function cutCells(
  codes: Uint32Array,
  size: number,
  starts: Uint32Array,
  ends: number[],
  first: number,
  limit: number,
): number {
  let cells = 0;
  // Ranges are cut from the left, so the starts come out in order.
  while (first < limit) {
    const end = ends[ends.length - 1] as number;
    if (end - first > size) ends.push(cutCell(codes, first, end));
    else {
      starts[cells++] = first;
      first = end;
      ends.pop();
    }
  }
  starts[cells] = limit;
  return cells;
}

/** Where a range of codes is cut: at the first with the highest bit that differs, or in the middle if all are equal. */
export function cutCell(codes: Uint32Array, first: number, end: number): number {
  const low = codes[first] as number,
    high = codes[end - 1] as number;
  if (low === high) return (first + end) >>> 1;
  const bit = 31 - Math.clz32(low ^ high);
  const pivot = (high >>> bit) << bit;
  let a = first,
    b = end - 1;
  while (a < b) {
    const middle = (a + b) >>> 1;
    if ((codes[middle] as number) < pivot) a = middle + 1;
    else b = middle;
  }
  return a;
}

/** Cuts primitives into clusters, whose boxes, weights and references are still to be set. */
export function cutClusters(primitives: Sorted, size: number, scratch: Memory): Clusters {
  const starts = scratch.uint32(primitives.count + 1);
  const count = cutCells(primitives.codes, size, starts, [primitives.count], 0, primitives.count);
  return {
    primitives,
    starts,
    count,
    boxes: scratch.float32(6 * count),
    weights: scratch.uint32(count),
    references: scratch.uint32(count),
  };
}

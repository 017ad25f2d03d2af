import { PAIR, type Primitives } from './primitives';
import type { Scratch } from './scratch';

/** Cells of primitives that lie together: the upper levels of a tree are built over these. */
export interface Clusters {
  /** Primitives' boxes in the sorted order. */
  readonly sorted: Float32Array;
  /** Boxes of the clusters. */
  readonly boxes: Float32Array;
  /** Triangles of each cluster. */
  readonly weights: Uint32Array;
  /** First sorted primitive of each cluster, and one entry more for the end. */
  readonly starts: Uint32Array;
  readonly count: number;
}

/**
 * Cuts primitives sorted by their Morton codes into octree cells of at most `size` primitives. Cells of equal codes are
 * cut by count.
 *
 * @returns Number of cells; their starts are written, and one entry more for the end.
 */
export function cutCells(codes: Uint32Array, count: number, size: number, starts: Uint32Array): number {
  let cells = 0;
  // Ends of the ranges still to cut; ranges are cut from the left, so the starts come out in order.
  const ends = new Uint32Array(64 + Math.ceil(Math.log2(count + 1)));
  let top = 0, first = 0;
  ends[top++] = count;
  while (top > 0) {
    const end = ends[top - 1] as number;
    if (end - first <= size) {
      if (end > first) starts[cells++] = first;
      first = end;
      top--;
    } else ends[top++] = cutCell(codes, first, end);
  }
  starts[cells] = count;
  return cells;
}

/** Where a range of codes is cut: at the first with the highest bit that differs, or in the middle if all are equal. */
export function cutCell(codes: Uint32Array, first: number, end: number): number {
  const low = codes[first] as number, high = codes[end - 1] as number;
  if (low === high) return (first + end) >>> 1;
  const bit = 31 - Math.clz32(low ^ high);
  const pivot = (high >>> bit) << bit;
  let a = first, b = end - 1;
  while (a < b) {
    const middle = (a + b) >>> 1;
    if ((codes[middle] as number) < pivot) a = middle + 1;
    else b = middle;
  }
  return a;
}

/** Copies the boxes of the primitives into their sorted order and measures the cells `from` to `to`. */
export function fillClusters({ sorted, boxes, weights, starts }: Clusters, primitives: Primitives, order: Uint32Array, from: number, to: number): void {
  const { boxes: unsorted, triangles } = primitives;
  let i = starts[from] as number;
  for (let cluster = from; cluster < to; cluster++) {
    let x0 = Infinity, y0 = Infinity, z0 = Infinity, x1 = -Infinity, y1 = -Infinity, z1 = -Infinity, weight = 0;
    const end = starts[cluster + 1] as number;
    for (; i < end; i++) {
      const primitive = order[i] as number;
      const b = 6 * primitive, s = 6 * i;
      const a0 = unsorted[b] as number, a1 = unsorted[b + 1] as number, a2 = unsorted[b + 2] as number;
      const a3 = unsorted[b + 3] as number, a4 = unsorted[b + 4] as number, a5 = unsorted[b + 5] as number;
      sorted[s] = a0;
      sorted[s + 1] = a1;
      sorted[s + 2] = a2;
      sorted[s + 3] = a3;
      sorted[s + 4] = a4;
      sorted[s + 5] = a5;
      if (a0 < x0) x0 = a0;
      if (a1 < y0) y0 = a1;
      if (a2 < z0) z0 = a2;
      if (a3 > x1) x1 = a3;
      if (a4 > y1) y1 = a4;
      if (a5 > z1) z1 = a5;
      weight += (triangles[primitive] as number) >= PAIR ? 2 : 1;
    }
    const c = 6 * cluster;
    boxes[c] = x0;
    boxes[c + 1] = y0;
    boxes[c + 2] = z0;
    boxes[c + 3] = x1;
    boxes[c + 4] = y1;
    boxes[c + 5] = z1;
    weights[cluster] = weight;
  }
}

/** Room for clusters; see {@link fillClusters}. */
export function roomForClusters(scratch: Scratch, codes: Uint32Array, count: number, size: number): Clusters {
  const starts = scratch.uint32(count + 1);
  const cells = cutCells(codes, count, size, starts);
  return { sorted: scratch.float32(6 * count), boxes: scratch.float32(6 * cells), weights: scratch.uint32(cells), starts, count: cells };
}

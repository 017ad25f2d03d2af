import { enclose } from '../layout';
import type { Primitives } from './primitives';
import type { Scratch } from './scratch';

/** Cells of primitives that lie together: the upper levels of a tree are built over these. */
export interface Clusters {
  /** Primitives' boxes in the sorted order. */
  readonly sorted: Float32Array;
  /** Primitives' first triangles in the sorted order, with `PAIR`. */
  readonly triangles: Uint32Array;
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
  const ends = [count];
  let first = 0;
  while (ends.length > 0) {
    const end = ends[ends.length - 1] as number;
    if (end - first > size) ends.push(cutCell(codes, first, end));
    else {
      if (end > first) starts[cells++] = first;
      first = end;
      ends.pop();
    }
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
export function fillClusters({ sorted, triangles, boxes, weights, starts }: Clusters, primitives: Primitives, order: Uint32Array, from: number, to: number): void {
  const { boxes: unsorted, triangles: names } = primitives;
  const box = new Float64Array(6);
  for (let cluster = from; cluster < to; cluster++) {
    const first = starts[cluster] as number, end = starts[cluster + 1] as number;
    let weight = end - first;
    for (let i = first; i < end; i++) {
      const primitive = order[i] as number;
      const b = 6 * primitive, s = 6 * i;
      sorted[s] = unsorted[b] as number;
      sorted[s + 1] = unsorted[b + 1] as number;
      sorted[s + 2] = unsorted[b + 2] as number;
      sorted[s + 3] = unsorted[b + 3] as number;
      sorted[s + 4] = unsorted[b + 4] as number;
      sorted[s + 5] = unsorted[b + 5] as number;
      const name = (triangles[i] = names[primitive] as number);
      weight += name >>> 31;
    }
    enclose(sorted, first, end, box);
    for (let k = 0; k < 6; k++) boxes[6 * cluster + k] = box[k] as number;
    weights[cluster] = weight;
  }
}

/** Room for clusters; see {@link fillClusters}. */
export function roomForClusters(scratch: Scratch, codes: Uint32Array, count: number, size: number): Clusters {
  const starts = scratch.uint32(count + 1);
  const cells = cutCells(codes, count, size, starts);
  return { sorted: scratch.float32(6 * count), triangles: scratch.uint32(count), boxes: scratch.float32(6 * cells), weights: scratch.uint32(cells), starts, count: cells };
}

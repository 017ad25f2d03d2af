import { putBox } from '../layout';
import type { Primitives } from './primitives';
import type { Sorted } from './morton';

/** Groups of primitives that lie together: the upper levels of a tree are built over these. */
export interface Clusters {
  /** Primitive boxes in the sorted order. */
  readonly sortedBoxes: Float32Array;
  /** Triangles of each primitive, 1 or 2, in the sorted order. */
  readonly sortedWeights: Uint32Array;
  /** Boxes of the clusters. */
  readonly boxes: Float32Array;
  /** Triangles of each cluster. */
  readonly weights: Uint32Array;
  /** First sorted primitive of each cluster, and one entry more for the end. */
  readonly starts: Uint32Array;
  readonly count: number;
}

/** Cuts the sorted primitives into octree cells of at most `size` primitives. Cells of equal codes are cut by count. */
export function makeClusters({ boxes, triangles, count }: Primitives, { order, codes }: Sorted, size: number): Clusters {
  const sortedBoxes = new Float32Array(count * 6);
  const sortedWeights = new Uint32Array(count);
  for (let i = 0, to = 0; i < count; i++, to += 6) {
    const primitive = order[i] as number;
    const from = 6 * primitive;
    for (let k = 0; k < 6; k++) sortedBoxes[to + k] = boxes[from + k] as number;
    sortedWeights[i] = 1 + ((triangles[primitive] as number) >>> 31);
  }
  const starts = new Uint32Array(count + 1);
  let clusters = 0;
  // Ends of the ranges still to cut; ranges are cut from the left, so the starts come out in order.
  const ends = new Uint32Array(64 + Math.ceil(Math.log2(count + 1)));
  let top = 0, first = 0;
  ends[top++] = count;
  while (top > 0) {
    const end = ends[top - 1] as number;
    if (end - first <= size) {
      if (end > first) starts[clusters++] = first;
      first = end;
      top--;
      continue;
    }
    const low = codes[first] as number, high = codes[end - 1] as number;
    let cut: number;
    if (low === high) cut = (first + end) >>> 1;
    else {
      // The first code with the highest bit that differs.
      const bit = 31 - Math.clz32(low ^ high);
      const pivot = (high >>> bit) << bit;
      let a = first, b = end - 1;
      while (a < b) {
        const middle = (a + b) >>> 1;
        if ((codes[middle] as number) < pivot) a = middle + 1;
        else b = middle;
      }
      cut = a;
    }
    ends[top++] = cut;
  }
  starts[clusters] = count;
  const clusterBoxes = new Float32Array(clusters * 6);
  const weights = new Uint32Array(clusters);
  for (let cluster = 0; cluster < clusters; cluster++) {
    let x0 = Infinity, y0 = Infinity, z0 = Infinity, x1 = -Infinity, y1 = -Infinity, z1 = -Infinity, weight = 0;
    const end = starts[cluster + 1] as number;
    for (let i = starts[cluster] as number; i < end; i++) {
      const b = 6 * i;
      const a0 = sortedBoxes[b] as number, a1 = sortedBoxes[b + 1] as number, a2 = sortedBoxes[b + 2] as number;
      const a3 = sortedBoxes[b + 3] as number, a4 = sortedBoxes[b + 4] as number, a5 = sortedBoxes[b + 5] as number;
      if (a0 < x0) x0 = a0;
      if (a1 < y0) y0 = a1;
      if (a2 < z0) z0 = a2;
      if (a3 > x1) x1 = a3;
      if (a4 > y1) y1 = a4;
      if (a5 > z1) z1 = a5;
      weight += sortedWeights[i] as number;
    }
    putBox(clusterBoxes, 6 * cluster, x0, y0, z0, x1, y1, z1);
    weights[cluster] = weight;
  }
  return { sortedBoxes, sortedWeights, boxes: clusterBoxes, weights, starts: starts.subarray(0, clusters + 1), count: clusters };
}

import type { TriangleMesh } from '../blas';
import { BLAS_MAX_DEPTH, leafReference } from '../layout';
import { makeClusters } from './clusters';
import { sortByMorton } from './morton';
import { NodeWriter, type Tree } from './node-writer';
import { makePrimitives } from './primitives';
import { rotate } from './rotate';
import { Splitter, SWEEP_MAX } from './splitter';

/** Depth kept for the inside of clusters: enough to halve one down to single triangles, with room for better splits. */
const CLUSTER_DEPTH = 12;

/** Numbers of a pending range: first, end, parent, right side, depth, inside of a cluster. */
const TASK = 6;

/** What {@link buildBalanced} gives. */
export interface BalancedTree extends Tree {
  /** Leaf order → triangle of the mesh. */
  readonly triangleIndices: Uint32Array<ArrayBuffer>;
  readonly bounds: Float64Array;
}

/**
 * Builds by surface area heuristic in three steps, each far cheaper than binning all triangles on every level: pairs of
 * neighbouring triangles become one primitive; Morton codes sort the primitives into small cells; the upper levels are
 * built over the cells, the lower ones within each; rotations then mend what the cells have cost. No recursion, no allocation per node, deterministic.
 *
 * @param maxLeaf Most triangles in a leaf.
 * @param bins Bins per axis of large ranges.
 */
export function buildBalanced(mesh: TriangleMesh, maxLeaf: number, bins: number): BalancedTree {
  const primitives = makePrimitives(mesh, maxLeaf > 1);
  const { count, triangleCount, bounds } = primitives;
  const writer = new NodeWriter(Math.max(count - 1, 1));
  const triangleIndices = new Uint32Array(triangleCount);
  const sorted = sortByMorton(primitives);
  const clusters = makeClusters(primitives, sorted, SWEEP_MAX);
  const inner = Uint32Array.from({ length: count }, (_, i) => i);
  const outer = Uint32Array.from({ length: clusters.count }, (_, i) => i);
  const splitter = new Splitter(bins);
  const tasks = new Int32Array((BLAS_MAX_DEPTH + 3) * TASK);
  let emitted = 0;

  const leaf = (first: number, end: number): number => {
    const start = emitted;
    for (let i = first; i < end; i++) {
      const triangle = primitives.triangles[sorted.order[inner[i] as number] as number] as number;
      triangleIndices[emitted++] = triangle & 0x7fffffff;
      if (triangle >>> 31) triangleIndices[emitted++] = (triangle & 0x7fffffff) + 1;
    }
    return leafReference(start, emitted - start);
  };

  if (count < 2) {
    // Both references name the one leaf; for no triangles at all, a leaf that is never reached.
    const root = writer.add(-1);
    const reference = count === 1 ? leaf(0, 1) : leafReference(0, 1);
    if (count === 1) writer.child(root, false, reference, ...(bounds as unknown as [number, number, number, number, number, number]));
    else writer.noChild(root, false, reference);
    writer.noChild(root, true, reference);
    return { ...writer.finish(), triangleIndices, bounds };
  }

  let top = 0;
  const push = (first: number, end: number, parent: number, right: number, depth: number, inside: number) => {
    const t = top++ * TASK;
    tasks[t] = first;
    tasks[t + 1] = end;
    tasks[t + 2] = parent;
    tasks[t + 3] = right;
    tasks[t + 4] = depth;
    tasks[t + 5] = inside;
  };
  push(0, clusters.count, -1, 0, 0, 0);
  while (top > 0) {
    const t = --top * TASK;
    let first = tasks[t] as number, end = tasks[t + 1] as number, inside = tasks[t + 5] as number;
    const parent = tasks[t + 2] as number, right = tasks[t + 3] === 1, depth = tasks[t + 4] as number;
    if (inside === 0 && end - first === 1) {
      const cluster = outer[first] as number;
      first = clusters.starts[cluster] as number;
      end = clusters.starts[cluster + 1] as number;
      inside = 1;
    }
    const size = end - first;
    const boxes = inside ? clusters.sortedBoxes : clusters.boxes;
    const weights = inside ? clusters.sortedWeights : clusters.weights;
    const order = inside ? inner : outer;
    // Levels that halving would need from here on.
    const halving = 32 - Math.clz32(size - 1);
    const free = depth + halving + 1 < (inside ? BLAS_MAX_DEPTH : BLAS_MAX_DEPTH - CLUSTER_DEPTH);
    if (size === 1 || !free) {
      splitter.measure(boxes, weights, order, first, end);
      splitter.cut = -1;
      splitter.cost = Infinity;
    } else if (size <= SWEEP_MAX) splitter.sweep(boxes, weights, order, first, end);
    else splitter.bin(boxes, weights, order, first, end);
    const { x0, y0, z0, x1, y1, z1, weight } = splitter;
    let { cut } = splitter;
    const dx = x1 - x0, dy = y1 - y0, dz = z1 - z0;
    const area = dx * dy + dy * dz + dz * dx;
    // Splitting must pay: costs are over the probability of a hit, which is the box's area.
    if (inside && parent >= 0 && weight <= maxLeaf && !(splitter.cost + area < weight * area)) {
      writer.child(parent, right, leaf(first, end), x0, y0, z0, x1, y1, z1);
      continue;
    }
    const node = writer.add(parent);
    if (parent >= 0) writer.child(parent, right, node, x0, y0, z0, x1, y1, z1);
    if (cut < 0) cut = (first + end) >>> 1;
    push(cut, end, node, 1, depth + 1, inside);
    push(first, cut, node, 0, depth + 1, inside);
  }
  return { ...rotate(writer.finish(), BLAS_MAX_DEPTH), triangleIndices, bounds };
}

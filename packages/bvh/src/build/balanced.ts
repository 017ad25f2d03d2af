import type { TriangleMesh } from '../blas';
import { BLAS_MAX_DEPTH, leafReference } from '../layout';
import { makeClusters } from './clusters';
import { buildLevels, counted } from './levels';
import { sortByMorton } from './morton';
import { NodeWriter, type Tree } from './node-writer';
import { makePrimitives } from './primitives';
import { rotate } from './rotate';
import { SWEEP_MAX } from './splitter';

/** Depth kept for the inside of clusters: enough to halve one down to single triangles, with room for better splits. */
const CLUSTER_DEPTH = 12;

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
  const inner = counted(count);
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
    writer.single(count === 1 ? leaf(0, 1) : leafReference(0, 1), count === 1 ? bounds : undefined);
    return { ...writer.finish(), triangleIndices, bounds };
  }

  buildLevels(writer, { boxes: clusters.boxes, weights: clusters.weights, order: counted(clusters.count) }, { boxes: clusters.sortedBoxes, weights: clusters.sortedWeights, order: inner }, clusters.starts, {
    maxLeaf,
    maxDepth: BLAS_MAX_DEPTH,
    outerDepth: BLAS_MAX_DEPTH - CLUSTER_DEPTH,
    bins,
    leaf,
  });
  return { ...rotate(writer, BLAS_MAX_DEPTH), triangleIndices, bounds };
}

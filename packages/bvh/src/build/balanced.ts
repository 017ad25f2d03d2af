import type { TriangleMesh } from '../blas';
import type { BuildSettings } from './builder';
import { Scratch } from './scratch';
import { buildUpper, emptyTree, keepNodes, makePrimitives, part, sortPrimitives, writeInsides, type Steps, type TriangleTree } from './steps';

/**
 * Builds by surface area heuristic in steps that are each far cheaper than binning all triangles on every level: pairs of
 * neighbouring triangles become one primitive; Morton codes sort the primitives into small cells; the upper levels are
 * built over the cells from the top down and mended by rotations; the lower ones within each cell from the bottom up. No
 * recursion, no allocation per node, deterministic.
 */
export function* buildBalanced(mesh: TriangleMesh, count: number, { maxLeaf, bins }: BuildSettings): Steps<TriangleTree> {
  const scratch = Scratch.take();
  const primitives = yield* part(makePrimitives(mesh, count, maxLeaf > 1, scratch), 0, 0.15);
  if (primitives.count === 0) return emptyTree();
  const sorted = yield* part(sortPrimitives(primitives, scratch), 0.15, 0.3);
  const upper = yield* part(buildUpper(primitives, sorted, bins, scratch), 0.3, 0.6);
  const triangleIndices = new Uint32Array(primitives.triangleCount);
  const writer = yield* part(writeInsides(upper, upper.clusters.triangles, triangleIndices, maxLeaf, scratch), 0.6, 0.95);
  const tree = yield* part(keepNodes(writer), 0.95, 1);
  scratch.giveBack();
  return { ...tree, triangleIndices, bounds: primitives.bounds };
}

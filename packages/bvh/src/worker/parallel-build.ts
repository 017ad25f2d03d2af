import { buildBalanced } from '../builders/balanced';
import type { BuildSettings } from '../builders/builder';
import { CLUSTER_DEPTH } from '../builders/cluster-trees';
import { encloseNodes, Levels } from '../builders/levels';
import { joinUpperLevels, STEP, type Steps, type TriangleTree } from '../builders/steps';
import { BLAS_MAX_DEPTH, type TriangleMesh } from '../layout';
import type { Team } from './team';
import { placeClusterTrees, shareClusterTrees, writerOver } from './parallel-clusters';
import { sharePrimitives, shareSorting } from './parallel-sort';
import { shareLevels, shareRotations } from './parallel-levels';

function finish<T>(steps: Steps<T>): T {
  let step = steps.next();
  while (!step.done) step = steps.next();
  return step.value;
}

/**
 * The tree of `balanced`, bit for bit, built by two workers. Each takes parts of a stage as it gets to them, since one
 * of the two is faster on most machines.
 *
 * @param mesh With arrays in shared memory.
 * @returns The tree, in the first worker; undefined in the second.
 * @throws {BvhError} as `buildBlas`; `bvh/worker` if the other worker has given up.
 */
export function buildInParallel(
  mesh: TriangleMesh,
  count: number,
  settings: BuildSettings,
  team: Team,
): TriangleTree | undefined {
  const { maxLeaf, bins } = settings;
  const pairs = maxLeaf > 1;
  const parts = sharePrimitives(mesh, count, pairs, team);
  const { triangleCount, bounds } = parts;
  // Little work, or all triangles in one place: not worth sharing.
  if (parts.count < 4 * STEP) return team.index === 0 ? finish(buildBalanced(mesh, count, settings)) : undefined;
  const inner = shareClusterTrees(shareSorting(parts, pairs, team), triangleCount, maxLeaf, team);
  const { clusters } = inner;

  const depth = BLAS_MAX_DEPTH - CLUSTER_DEPTH;
  const upper = writerOver(team.memory.upper, clusters.count);
  // Results are in memory that is not shared, and allocating it costs more than the copying.
  const own = shareLevels(upper, clusters, depth, bins, team, () => ({
    writer: placeClusterTrees(inner),
    triangleIndices: inner.leaves.slice(),
  }));
  shareRotations(upper, team);
  if (!own) return undefined;
  const { writer, triangleIndices } = own;
  if (finish(joinUpperLevels(upper, clusters, writer)) > depth) {
    // Rotations make few trees too deep: these are built again without.
    upper.count = 0;
    const levels = new Levels(upper, clusters, depth, bins);
    while (levels.step(Infinity));
    encloseNodes(upper, 0, upper.count);
    finish(joinUpperLevels(upper, clusters, writer));
  }
  return { nodes: writer.nodes, nodeCount: writer.count, triangleIndices, bounds };
}

import { buildBalanced } from '../build/balanced';
import type { BuildSettings } from '../build/builder';
import { CLUSTER_DEPTH } from '../build/insides';
import { encloseNodes, Levels } from '../build/levels';
import { crown, STEP, type Steps, type TriangleTree } from '../build/steps';
import { BLAS_MAX_DEPTH, type TriangleMesh } from '../layout';
import type { Team } from './team';
import { placeInsides, shareInsides, writerOver } from './together-insides';
import { sharePrimitives, shareSorting } from './together-sorted';
import { shareLevels, shareRotations } from './together-upper';

function finish<T>(steps: Steps<T>): T {
  let step = steps.next();
  while (!step.done) step = steps.next();
  return step.value;
}

/**
 * The tree of `balanced`, bit for bit, by two workers, who take their parts of each stage as they come to it: on most
 * machines one of them is faster.
 *
 * @param mesh With arrays that both see.
 * @returns The tree, to the first; undefined to the second.
 * @throws {BvhError} as `buildBlas`; `bvh/worker` where the other one has given up.
 */
export function buildTogether(
  mesh: TriangleMesh,
  count: number,
  settings: BuildSettings,
  team: Team,
): TriangleTree | undefined {
  const { maxLeaf, bins } = settings;
  const pairs = maxLeaf > 1;
  const parts = sharePrimitives(mesh, count, pairs, team);
  const { triangleCount, bounds } = parts;
  // Little work, or all on one spot: not worth sharing.
  if (parts.count < 4 * STEP) return team.index === 0 ? finish(buildBalanced(mesh, count, settings)) : undefined;
  const inner = shareInsides(shareSorting(parts, pairs, team), triangleCount, maxLeaf, team);
  const { clusters } = inner;

  const depth = BLAS_MAX_DEPTH - CLUSTER_DEPTH;
  const upper = writerOver(team.memory.upper, clusters.count);
  // What is handed out lies in memory of its own, and fresh memory costs more than the copying.
  const own = shareLevels(upper, clusters, depth, bins, team, () => ({
    writer: placeInsides(inner),
    triangleIndices: inner.leaves.slice(),
  }));
  shareRotations(upper, team);
  if (!own) return undefined;
  const { writer, triangleIndices } = own;
  if (finish(crown(upper, clusters, writer)) > depth) {
    // Rotations make few trees too deep: these stay as they were.
    upper.count = 0;
    const levels = new Levels(upper, clusters, depth, bins);
    while (levels.step(Infinity));
    encloseNodes(upper, 0, upper.count);
    finish(crown(upper, clusters, writer));
  }
  return { nodes: writer.nodes, nodeCount: writer.count, triangleIndices, bounds };
}

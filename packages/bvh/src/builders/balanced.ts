import type { TriangleMesh } from '../layout';
import type { BuildSettings } from './builder';
import { Scratch } from './scratch';
import {
  buildNodes,
  emptyTree,
  gather,
  keepNodes,
  makePrimitives,
  part,
  sortPrimitives,
  type Steps,
  type TriangleTree,
} from './steps';

/** Triangles of the mesh that is built first: enough for splits. */
const MODEL = 600;

/**
 * V8 drops machine code when the last object of the shape that it was compiled for is collected, so that a build after
 * a garbage collection would start with cold code. So the objects of one small build are retained.
 */
let models: object[] | undefined;

/**
 * Builds by surface area heuristic in steps that are each far cheaper than binning all triangles on every level: pairs
 * of neighbouring triangles become one primitive; Morton codes sort the primitives into small cells; the upper levels
 * are built over the cells from the top down and improved by rotations; the lower ones within each cell from the bottom
 * up. No recursion, no allocation per node, deterministic.
 */
export function* buildBalanced(
  mesh: TriangleMesh,
  count: number,
  settings: BuildSettings,
  kept?: object[],
): Steps<TriangleTree> {
  const { maxLeaf, bins } = settings;
  if (!models) {
    models = [];
    const positions = new Float32Array(9 * MODEL).map((_, i) => Math.sin(i * (i % 30)));
    const steps = buildBalanced(
      { positions, indices: new Uint32Array(3 * MODEL).map((_, i) => i) },
      MODEL,
      settings,
      models,
    );
    while (!steps.next().done) yield 0;
  }
  const scratch = Scratch.take();
  scratch.kept = kept;
  const primitives = yield* part(makePrimitives(mesh, count, maxLeaf > 1, scratch), 0, 0.15);
  if (primitives.count === 0) return emptyTree(primitives);
  const order = yield* part(sortPrimitives(primitives, scratch), 0.15, 0.25);
  const sorted = yield* part(gather(primitives, order, maxLeaf > 1, scratch), 0.25, 0.35);
  const triangleIndices = new Uint32Array(primitives.triangleCount);
  const writer = yield* part(buildNodes(sorted, triangleIndices, bins, maxLeaf, scratch), 0.35, 0.95);
  const tree = yield* part(keepNodes(writer), 0.95, 1);
  scratch.giveBack();
  return { ...tree, triangleIndices, bounds: primitives.bounds };
}

import type { TriangleMesh } from '../blas';
import { BLAS_MAX_DEPTH, leafReference } from '../layout';
import { GROUP_MAX } from './agglomerate';
import { fillClusters, roomForClusters } from './clusters';
import { Insides } from './insides';
import { counted, Levels } from './levels';
import { MortonSort } from './morton';
import { NodeWriter, type Tree } from './node-writer';
import { PrimitiveMaker } from './primitives';
import { Rotations } from './rotate';
import { Scratch } from './scratch';

/** Depth kept for the inside of clusters: enough to halve one down to single primitives. */
const CLUSTER_DEPTH = Math.ceil(Math.log2(GROUP_MAX));

/** Items that one step looks at: a millisecond or two. */
const STEP = 1 << 15;

/** A bottom-level tree. */
export interface TriangleTree extends Tree {
  /** Leaf order → triangle of the mesh. */
  readonly triangleIndices: Uint32Array<ArrayBuffer>;
  readonly bounds: Float64Array;
}

/**
 * Builds by surface area heuristic in steps that are each far cheaper than binning all triangles on every level: pairs of
 * neighbouring triangles become one primitive; Morton codes sort the primitives into small cells; the upper levels are
 * built over the cells from the top down and mended by rotations; the lower ones within each cell from the bottom up. No
 * recursion, no allocation per node, deterministic.
 *
 * @param maxLeaf Most triangles in a leaf.
 * @param bins Bins per axis.
 * @returns Steps of a few milliseconds at most; each yields the share that is done, 0..1.
 */
export function* buildBalanced(mesh: TriangleMesh, count: number, maxLeaf: number, bins: number): Generator<number, TriangleTree> {
  const scratch = Scratch.take();
  const primitives = new PrimitiveMaker(mesh, count, maxLeaf > 1, scratch);
  for (let from = 0; from < count; from += STEP) {
    primitives.add(from, Math.min(count, from + STEP));
    yield (0.1 * from) / count;
  }
  const { triangles, bounds, count: size } = primitives;
  const triangleIndices = new Uint32Array(primitives.triangleCount);
  if (size === 0) {
    const writer = new NodeWriter(1);
    writer.single(leafReference(0, 1), undefined);
    return { ...writer.finish(), triangleIndices, bounds };
  }
  const sort = new MortonSort(primitives, scratch);
  for (let from = 0; from < size; from += STEP) {
    sort.encode(from, Math.min(size, from + STEP));
    yield 0.1 + (0.05 * from) / size;
  }
  sort.begin();
  for (let pass = 0; pass < 3; pass++) {
    for (let from = 0; from < size; from += 2 * STEP) {
      sort.scatter(pass, from, Math.min(size, from + 2 * STEP));
      yield 0.15 + 0.05 * pass + (0.05 * from) / size;
    }
    sort.swap();
  }
  const { order, codes } = sort;
  const clusters = roomForClusters(scratch, codes, size, GROUP_MAX);
  for (let from = 0; from < clusters.count; from += STEP >> 3) {
    fillClusters(clusters, primitives, order, from, Math.min(clusters.count, from + (STEP >> 3)));
    yield 0.3 + (0.05 * from) / size;
  }

  const upper = new NodeWriter(clusters.count, scratch.buffer(64 * clusters.count));
  const places = counted(scratch.uint32(clusters.count), clusters.count);
  const depth = BLAS_MAX_DEPTH - CLUSTER_DEPTH;
  if (clusters.count > 1) {
    const levels = new Levels(upper, { boxes: clusters.boxes, weights: clusters.weights, order: places, count: clusters.count }, depth, bins);
    while (levels.step(STEP)) yield 0.35;
    const rotations = new Rotations(upper, depth);
    while (rotations.step(STEP)) yield 0.6;
  }
  const writer = new NodeWriter(size, scratch.buffer(64 * size));
  const insides = new Insides(writer, { upper, places, clusters, order, triangles, triangleIndices, maxLeaf, maxDepth: BLAS_MAX_DEPTH });
  while (insides.step(STEP >> 4)) yield 0.7 + (0.3 * writer.count) / size;
  const tree = writer.finish();
  scratch.giveBack();
  return { ...tree, triangleIndices, bounds };
}

import type { TriangleMesh } from '../blas';
import { BLAS_MAX_DEPTH, leafReference, NODE_WORDS } from '../layout';
import { GROUP_MAX } from './agglomerate';
import { fillClusters, roomForClusters, type Clusters } from './clusters';
import { Insides } from './insides';
import { counted, Levels } from './levels';
import { MortonSort } from './morton';
import { NodeWriter, type Tree } from './node-writer';
import { PrimitiveMaker, type Primitives } from './primitives';
import { Rotations } from './rotate';
import type { Scratch } from './scratch';

/** Items that one step looks at: a millisecond or two. */
export const STEP = 1 << 14;

/** Depth kept for the inside of clusters: enough to halve one down to single primitives, log2 of {@link GROUP_MAX}. */
const CLUSTER_DEPTH = 4;

/** A bottom-level tree. */
export interface TriangleTree extends Tree {
  /** Leaf order → triangle of the mesh. */
  readonly triangleIndices: Uint32Array<ArrayBuffer>;
  /** Box of all: min xyz, max xyz. */
  readonly bounds: Float64Array;
}

/** Parts of a build: generators that do a few milliseconds of work at a time and yield the share of the part that is done. */
export type Steps<T> = Generator<number, T>;

/** Runs a part as the share `from` to `to` of a whole. */
export function* part<T>(steps: Steps<T>, from: number, to: number): Steps<T> {
  let step = steps.next();
  for (; !step.done; step = steps.next()) yield from + (to - from) * step.value;
  return step.value;
}

/** A mesh's triangles as primitives. */
export function* makePrimitives(mesh: TriangleMesh, count: number, pairs: boolean, scratch: Scratch): Steps<PrimitiveMaker> {
  const primitives = new PrimitiveMaker(mesh, count, pairs, scratch);
  for (let from = 0; from < count; from += STEP) {
    primitives.add(from, Math.min(count, from + STEP));
    yield from / count;
  }
  return primitives;
}

/** Primitives in the order of a space-filling curve. */
export interface Sorted {
  /** Primitives by their Morton codes. */
  readonly order: Uint32Array<ArrayBuffer>;
  readonly codes: Uint32Array<ArrayBuffer>;
}

/** Sorts primitives along a space-filling curve. */
export function* sortPrimitives(primitives: Primitives, scratch: Scratch): Steps<Sorted> {
  const { count } = primitives;
  const sort = new MortonSort(primitives, scratch);
  for (let from = 0; from < count; from += STEP) {
    sort.encode(from, Math.min(count, from + STEP));
    yield (0.25 * from) / count;
  }
  sort.begin();
  for (let pass = 0; pass < 3; pass++) {
    for (let from = 0; from < count; from += STEP) {
      sort.scatter(pass, from, Math.min(count, from + STEP));
      yield 0.25 * (pass + 1 + from / count);
    }
    sort.swap();
  }
  return { order: sort.order, codes: sort.codes };
}

/** A tree over clusters of primitives. */
export interface Upper {
  readonly clusters: Clusters;
  /** Nodes; the leaves name places in `places`. Empty for a single cluster. */
  readonly upper: NodeWriter;
  /** Place in the leaf order → cluster. */
  readonly places: Uint32Array;
}

/** Cuts sorted primitives into clusters, builds over them and mends that by rotations. */
export function* buildUpper(primitives: Primitives, { order, codes }: Sorted, bins: number, scratch: Scratch): Steps<Upper> {
  const clusters = roomForClusters(scratch, codes, primitives.count, GROUP_MAX);
  const { count } = clusters;
  yield 0;
  for (let from = 0; from < count; from += STEP >> 3) {
    fillClusters(clusters, primitives, order, from, Math.min(count, from + (STEP >> 3)));
    yield (0.2 * from) / count;
  }
  const upper = new NodeWriter(count, scratch.buffer(4 * NODE_WORDS * count));
  const places = counted(scratch.uint32(count), count);
  if (count > 1) {
    const depth = BLAS_MAX_DEPTH - CLUSTER_DEPTH;
    const levels = new Levels(upper, { boxes: clusters.boxes, weights: clusters.weights, order: places, count }, depth, bins);
    while (levels.step(STEP)) yield 0.2 + (0.6 * upper.count) / count;
    const rotations = new Rotations(upper, depth);
    yield 0.8;
    while (rotations.step(STEP)) yield 0.8;
  }
  return { clusters, upper, places };
}

/**
 * Writes the whole tree: the upper levels, and trees inside the clusters.
 *
 * @param triangles Sorted primitive → first triangle, with `PAIR`.
 * @param maxLeaf 0: one primitive a leaf.
 * @returns Its nodes in scratch memory.
 */
export function* writeInsides(upper: Upper, triangles: Uint32Array, triangleIndices: Uint32Array, maxLeaf: number, scratch: Scratch): Steps<NodeWriter> {
  const count = triangles.length;
  const writer = new NodeWriter(count, scratch.buffer(4 * NODE_WORDS * count));
  const insides = new Insides(writer, { ...upper, triangles, triangleIndices, maxLeaf, maxDepth: BLAS_MAX_DEPTH });
  while (insides.step(STEP >> 4)) yield writer.count / count;
  return writer;
}

/** Copies nodes out of scratch memory. */
export function* keepNodes({ nodes: from, count: nodeCount }: NodeWriter): Steps<Tree> {
  const nodes = new Float32Array(nodeCount * NODE_WORDS);
  for (let at = 0; at < nodes.length; at += NODE_WORDS * STEP) {
    nodes.set(from.subarray(at, Math.min(nodes.length, at + NODE_WORDS * STEP)), at);
    yield at / nodes.length;
  }
  return { nodes, nodeCount };
}

/** A tree that is never hit. */
export function emptyTree(): TriangleTree {
  const writer = new NodeWriter(1);
  writer.single(leafReference(0, 1));
  return { nodes: writer.nodes, nodeCount: 1, triangleIndices: new Uint32Array(0), bounds: Float64Array.of(Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity) };
}

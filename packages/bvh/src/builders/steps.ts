import {
  BLAS_MAX_DEPTH,
  LEAF,
  leafFirst,
  leafReference,
  NODE_WORDS,
  PARENT,
  RIGHT,
  type TriangleMesh,
} from '../layout';
import { GROUP_MAX } from './agglomerate';
import { cutClusters, type Clusters } from './clusters';
import { Gatherer, type Sorted } from './gather';
import { CLUSTER_DEPTH, ClusterTrees } from './cluster-trees';
import { encloseNodes, Levels } from './levels';
import { MortonSort } from './morton';
import { NodeWriter, type Tree } from './node-writer';
import { PrimitiveMaker, type Primitives } from './primitives';
import { rotate } from './rotate';
import type { Scratch } from './scratch';
import { each, part, STEP, type Steps } from './slices';

export { part, STEP, type Steps } from './slices';

/** A bottom-level tree. */
export interface TriangleTree extends Tree {
  /** Leaf order → triangle of the mesh. */
  readonly triangleIndices: Uint32Array<ArrayBuffer>;
  /** Box of all: min xyz, max xyz. */
  readonly bounds: Float64Array;
}

/** A mesh's triangles as primitives. */
export function* makePrimitives(
  mesh: TriangleMesh,
  count: number,
  pairs: boolean,
  scratch: Scratch,
): Steps<PrimitiveMaker> {
  const primitives = new PrimitiveMaker(mesh, count, pairs, scratch);
  yield* each(count, STEP, (from, to) => primitives.add(from, to));
  return primitives;
}

/** Primitives in the order of a space-filling curve. */
export interface Order {
  /** Primitives by their Morton codes. */
  readonly order: Uint32Array<ArrayBuffer>;
  readonly codes: Uint32Array<ArrayBuffer>;
}

/** Sorts primitives along a space-filling curve. */
export function* sortPrimitives(primitives: Primitives, scratch: Scratch): Steps<Order> {
  const { count } = primitives;
  const sort = new MortonSort(primitives, scratch);
  yield* part(
    each(count, STEP, (from, to) => sort.encode(from, to)),
    0,
    0.25,
  );
  scratch.kept?.push(sort);
  sort.begin();
  for (let pass = 0; pass < 3; pass++) {
    yield* part(
      each(count, STEP, (from, to) => sort.scatter(pass, from, to)),
      0.25 * (pass + 1),
      0.25 * (pass + 2),
    );
    sort.swap();
  }
  return sort;
}

/** Copies primitives into their order. */
export function* gather(
  primitives: Primitives,
  { order, codes }: Order,
  pairs: boolean,
  scratch: Scratch,
): Steps<Sorted> {
  const gatherer = new Gatherer(primitives, order, codes, pairs, scratch);
  yield* each(primitives.count, STEP, (from, to) => gatherer.add(from, to));
  return gatherer;
}

/**
 * Builds a tree over sorted primitives: clusters of neighbours joined bottom up, the levels above them split from the
 * top down and improved by rotations. The upper nodes come first.
 *
 * @param leaves Receives the triangles of the primitives in leaf order.
 * @param maxLeaf 0: one primitive a leaf.
 * @returns Its nodes in scratch memory.
 */
export function* buildNodes(
  primitives: Sorted,
  leaves: Uint32Array,
  bins: number,
  maxLeaf: number,
  scratch: Scratch,
): Steps<NodeWriter> {
  const clusters = cutClusters(primitives, GROUP_MAX, scratch);
  const { count } = clusters;
  yield 0;
  const writer = new NodeWriter(primitives.count, scratch.buffer(4 * NODE_WORDS * primitives.count));
  writer.count = count - 1;
  const trees = new ClusterTrees(clusters, writer, leaves, maxLeaf);
  yield* part(
    each(count, STEP >> 5, (from, to) => trees.build(from, to)),
    0,
    0.6,
  );
  if (count === 1) {
    if (writer.count === 0) writer.single(clusters.references[0] as number, clusters.boxes.subarray(0, 6));
    return writer;
  }
  const upper = new NodeWriter(count, scratch.buffer(4 * NODE_WORDS * count));
  const depth = BLAS_MAX_DEPTH - CLUSTER_DEPTH;
  // Rotations make few trees too deep: these are built again without.
  for (let rotations = true; ; rotations = false) {
    upper.count = 0;
    const levels = new Levels(upper, clusters, depth, bins);
    scratch.kept?.push(scratch, trees, levels);
    yield 0.6;
    while (levels.step(STEP)) yield rotations ? 0.6 + (0.3 * upper.count) / count : 0.95;
    encloseNodes(upper, 0, upper.count);
    yield 0.9;
    if (rotations) yield* part(rotate(upper), 0.9, 0.95);
    if ((yield* joinUpperLevels(upper, clusters, writer)) <= depth) return writer;
  }
}

/**
 * Writes the nodes over the clusters before the others, depth first, and joins them to the trees in the clusters.
 *
 * @returns The depth of the upper levels.
 */
export function* joinUpperLevels(
  { nodes: from, words: fromWords }: NodeWriter,
  { references }: Clusters,
  { nodes, words }: NodeWriter,
): Steps<number> {
  // Pending nodes of the upper tree, left ones above right ones; the words of their references; their depths.
  const stack: number[] = [];
  let count = 0,
    deepest = 0;
  for (let node = 0, slot = 0, depth = 1; ; depth++) {
    deepest = Math.max(deepest, depth);
    const a = node * NODE_WORDS,
      b = count * NODE_WORDS;
    // The root's reference goes to a word that the copy overwrites.
    words[slot] = count;
    for (let k = 0; k < NODE_WORDS; k++) nodes[b + k] = from[a + k] as number;
    words[b + PARENT] = slot >>> 4;
    if (++count % STEP === 0) yield 0.95;
    for (let side = RIGHT; side > 0; side -= 4) {
      const child = fromWords[a + side] as number;
      if (child < LEAF) {
        stack.push(child, b + side, depth);
        continue;
      }
      const reference = references[leafFirst(child)] as number;
      words[b + side] = reference;
      if (reference < LEAF) words[reference * NODE_WORDS + PARENT] = b >>> 4;
    }
    if (stack.length === 0) return deepest;
    depth = stack.pop() as number;
    slot = stack.pop() as number;
    node = stack.pop() as number;
  }
}

/** Copies nodes out of scratch memory. */
export function* keepNodes({ nodes: from, count: nodeCount }: NodeWriter): Steps<Tree> {
  const nodes = new Float32Array(nodeCount * NODE_WORDS);
  yield* each(nodes.length, NODE_WORDS * STEP, (at, end) => nodes.set(from.subarray(at, end), at));
  return { nodes, nodeCount };
}

/** A tree that is never hit, over no primitives. */
export function emptyTree({ bounds }: Primitives): TriangleTree {
  const writer = new NodeWriter(1);
  writer.single(leafReference(0, 1));
  return { ...writer.finish(), triangleIndices: new Uint32Array(0), bounds };
}

import { BvhError } from '../error';
import { NODE_WORDS, PARENT, parentsFirst } from '../layout';
import { WIDE_WORDS } from '../wide/layout';

/** Nodes of either layout. */
export interface AnyNodes {
  readonly nodes: Float32Array | Uint32Array;
  readonly nodeCount: number;
}

/** Nodes on the longest way from the root. */
export function depthOf({ nodes, nodeCount }: AnyNodes): number {
  const words = new Uint32Array(nodes.buffer, nodes.byteOffset, nodes.length);
  const wide = nodes.length === WIDE_WORDS * nodeCount;
  const depths = new Uint8Array(nodeCount).fill(1, 0, 1);
  let max = 1;
  // Wide nodes come after those above them.
  for (const node of wide ? depths.keys() : parentsFirst(words, nodeCount)) {
    if (!wide && node > 0) depths[node] = (depths[words[node * NODE_WORDS + PARENT] as number] as number) + 1;
    const depth = depths[node] as number;
    max = Math.max(max, depth);
    if (!wide) continue;
    const first = words[node * WIDE_WORDS + 4] as number;
    let inner = (words[node * WIDE_WORDS + 3] as number) >>> 24;
    for (let child = first; inner !== 0; inner &= inner - 1) depths[child++] = depth + 1;
  }
  return max;
}

/** Entries that a ray's stack needs for such a TLAS and the deepest of these BLAS. */
export function stackSizeOf(tlas: AnyNodes, trees: Iterable<AnyNodes>): number {
  let deepest = 0;
  for (const tree of trees) deepest = Math.max(deepest, depthOf(tree));
  // With two children, one waits at each node, and both levels have a mark at their end. With eight, a node's siblings
  // do.
  const marks = tlas.nodes.length === WIDE_WORDS * tlas.nodeCount ? 0 : 2;
  return Math.max(3, depthOf(tlas) + deepest + marks);
}

/** @throws {BvhError} `bvh/options` */
export function checkedStackSize(stackSize: number, max: number): number {
  if (!(Number.isInteger(stackSize) && stackSize >= 3 && stackSize <= max))
    throw new BvhError('bvh/options', `stackSize is ${stackSize}; it must be a whole number from 3 to ${max}.`);
  return stackSize;
}

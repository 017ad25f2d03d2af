import { FAR, LEAF, LEFT, LEFT_MAX, LEFT_MIN, leafCount, NODE_WORDS, PARENT, RIGHT, RIGHT_MAX, RIGHT_MIN, rootBounds } from './layout';

/** The nodes of a BLAS or TLAS. */
export interface BvhNodes {
  readonly nodes: Float32Array<ArrayBuffer>;
  readonly nodeCount: number;
}

/** What {@link bvhStatistics} tells. */
export interface BvhStatistics {
  /** Expected cost of a ray that hits the root's box: 1 per node visited and 1 per primitive tested (Goldsmith and Salmon 1987). */
  readonly sahCost: number;
  /** Inner nodes on the longest way to a leaf. */
  readonly depth: number;
  readonly nodes: number;
  readonly leaves: number;
  /** Leaves by their number of primitives; index 0 is unused. */
  readonly leafSizes: readonly number[];
}

/** Measures a hierarchy. */
export function bvhStatistics(bvh: BvhNodes): BvhStatistics {
  const { nodes, nodeCount } = bvh;
  const words = new Uint32Array(nodes.buffer, nodes.byteOffset, nodes.length);
  const leafSizes: number[] = new Array<number>(17).fill(0);
  const depths = new Uint8Array(nodeCount);
  let cost = 0, depth = 0, leaves = 0;
  const surface = (min: ArrayLike<number>, max: ArrayLike<number>, low = 0, high = 0) => {
    const [x, y, z] = [0, 1, 2].map((k) => (max[high + k] as number) - (min[low + k] as number)) as [number, number, number];
    return x * y + y * z + z * x;
  };
  for (let node = 0; node < nodeCount; node++) {
    const base = node * NODE_WORDS;
    depths[node] = node === 0 ? 1 : (depths[words[base + PARENT] as number] as number) + 1;
    depth = Math.max(depth, depths[node] as number);
    for (const [at, low, high] of [[LEFT, LEFT_MIN, LEFT_MAX], [RIGHT, RIGHT_MIN, RIGHT_MAX]] as const) {
      if (nodes[base + low] === Math.fround(FAR)) continue;
      const area = surface(nodes, nodes, base + low, base + high);
      const reference = words[base + at] as number;
      const count = (reference & LEAF) === 0 ? 1 : leafCount(reference);
      cost += area * count;
      if ((reference & LEAF) !== 0) {
        leaves++;
        leafSizes[count] = (leafSizes[count] as number) + 1;
      }
    }
  }
  const root = rootBounds(nodes);
  const total = surface(root.min, root.max);
  return { sahCost: total > 0 ? 1 + cost / total : nodeCount, depth, nodes: nodeCount, leaves, leafSizes };
}

/** The surface area cost alone, see {@link BvhStatistics.sahCost}. */
export const sahCost = (bvh: BvhNodes): number => bvhStatistics(bvh).sahCost;

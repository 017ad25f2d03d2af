import { FAR, LEAF, LEFT, LEFT_MAX, LEFT_MIN, leafCount, NODE_WORDS, PARENT, RIGHT, RIGHT_MAX, RIGHT_MIN } from './layout';

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
  const root = { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
  for (let node = 0; node < nodeCount; node++) {
    const base = node * NODE_WORDS;
    depths[node] = node === 0 ? 1 : (depths[words[base + PARENT] as number] as number) + 1;
    depth = Math.max(depth, depths[node] as number);
    for (const [at, low, high] of [[LEFT, LEFT_MIN, LEFT_MAX], [RIGHT, RIGHT_MIN, RIGHT_MAX]] as const) {
      if (nodes[base + low] === Math.fround(FAR)) continue;
      const size = [0, 1, 2].map((k) => (nodes[base + high + k] as number) - (nodes[base + low + k] as number)) as [number, number, number];
      const area = size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
      const reference = words[base + at] as number;
      const count = (reference & LEAF) === 0 ? 1 : leafCount(reference);
      cost += area * count;
      if ((reference & LEAF) !== 0) {
        leaves++;
        leafSizes[count] = (leafSizes[count] as number) + 1;
      }
      if (node === 0) {
        for (let k = 0; k < 3; k++) {
          root.min[k] = Math.min(root.min[k] as number, nodes[base + low + k] as number);
          root.max[k] = Math.max(root.max[k] as number, nodes[base + high + k] as number);
        }
      }
    }
  }
  const [x, y, z] = [0, 1, 2].map((k) => (root.max[k] as number) - (root.min[k] as number)) as [number, number, number];
  const total = x * y + y * z + z * x;
  return { sahCost: total > 0 ? 1 + cost / total : nodeCount, depth, nodes: nodeCount, leaves, leafSizes };
}

/** The surface area cost alone, see {@link BvhStatistics.sahCost}. */
export const sahCost = (bvh: BvhNodes): number => bvhStatistics(bvh).sahCost;

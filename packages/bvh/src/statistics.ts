import { FAR, LEAF, LEFT, LEFT_MIN, leafCount, NODE_WORDS, PARENT, parentsFirst, RIGHT, RIGHT_MIN } from './layout';

/** The nodes of a BLAS or TLAS. */
export interface BvhNodes {
  readonly nodes: Float32Array<ArrayBuffer>;
  readonly nodeCount: number;
}

/** The result of {@link bvhStatistics}. */
export interface BvhStatistics {
  /**
   * Expected cost of a ray that hits the root's box: 1 per node visited and 1 per primitive tested (Goldsmith and
   * Salmon 1987).
   */
  readonly sahCost: number;
  /** Inner nodes on the longest path to a leaf. */
  readonly depth: number;
  readonly nodes: number;
  readonly leaves: number;
  /** Leaves by their number of primitives; index 0 is unused. */
  readonly leafSizes: readonly number[];
  /** Leaves by the inner nodes on the path to them; index 0 is unused, and the last is {@link depth}. */
  readonly leafDepths: readonly number[];
}

const surface = (x: number, y: number, z: number): number => x * y + y * z + z * x;

/** Half the surface of the box whose corners lie at `low` and four words on. */
const boxSurface = (nodes: Float32Array, low: number): number =>
  surface(
    (nodes[low + 4] as number) - (nodes[low] as number),
    (nodes[low + 5] as number) - (nodes[low + 1] as number),
    (nodes[low + 6] as number) - (nodes[low + 2] as number),
  );

/** Half the surface of the root's box; 0 for an empty tree. */
function rootSurface(nodes: Float32Array): number {
  if (nodes[LEFT_MIN] === FAR) return 0;
  if (nodes[RIGHT_MIN] === FAR) return boxSurface(nodes, LEFT_MIN);
  const side = (k: number) =>
    Math.max(nodes[LEFT_MIN + 4 + k] as number, nodes[RIGHT_MIN + 4 + k] as number) -
    Math.min(nodes[LEFT_MIN + k] as number, nodes[RIGHT_MIN + k] as number);
  return surface(side(0), side(1), side(2));
}

/** Measures a hierarchy. */
export function bvhStatistics(bvh: BvhNodes): BvhStatistics {
  const { nodes, nodeCount } = bvh;
  const words = new Uint32Array(nodes.buffer, nodes.byteOffset, nodes.length);
  const leafSizes: number[] = new Array<number>(17).fill(0);
  const leafDepths: number[] = [0];
  const depths = new Uint8Array(nodeCount);
  let depth = 0,
    leaves = 0;
  for (const node of parentsFirst(words, nodeCount)) {
    const base = node * NODE_WORDS;
    const own = node === 0 ? 1 : (depths[words[base + PARENT] as number] as number) + 1;
    depths[node] = own;
    while (depth < own) leafDepths[++depth] = 0;
    for (const [at, low] of [
      [LEFT, LEFT_MIN],
      [RIGHT, RIGHT_MIN],
    ] as const) {
      const reference = words[base + at] as number;
      if (nodes[base + low] === FAR || reference < LEAF) continue;
      leaves++;
      leafSizes[leafCount(reference)] = (leafSizes[leafCount(reference)] as number) + 1;
      leafDepths[own] = (leafDepths[own] as number) + 1;
    }
  }
  return { sahCost: sahCost(bvh), depth, nodes: nodeCount, leaves, leafSizes, leafDepths };
}

/** The surface area cost alone, see {@link BvhStatistics.sahCost}; a few milliseconds for a million triangles. */
export function sahCost({ nodes, nodeCount }: BvhNodes): number {
  const words = new Uint32Array(nodes.buffer, nodes.byteOffset, nodes.length);
  let cost = 0;
  for (let base = 0; base < nodeCount * NODE_WORDS; base += NODE_WORDS) {
    const left = words[base + LEFT] as number,
      right = words[base + RIGHT] as number;
    cost += boxSurface(nodes, base + LEFT_MIN) * (left < LEAF ? 1 : leafCount(left));
    // The box of a missing child is a point: nothing is added.
    cost += boxSurface(nodes, base + RIGHT_MIN) * (right < LEAF ? 1 : leafCount(right));
  }
  const total = rootSurface(nodes);
  return total > 0 ? 1 + cost / total : nodeCount;
}

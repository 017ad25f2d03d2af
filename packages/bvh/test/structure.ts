import { expect } from 'vitest';
import { BLAS_MAX_DEPTH, type Blas, type TriangleMesh } from '../src/index';
import {
  FAR,
  LEAF,
  LEFT,
  LEFT_MAX,
  LEFT_MIN,
  leafCount,
  leafFirst,
  NODE_WORDS,
  PARENT,
  RIGHT,
  RIGHT_MAX,
  RIGHT_MIN,
} from '../src/layout';

/** Walks a hierarchy and checks everything that a traversal relies on. Returns the depth. */
export function checkStructure(
  tree: { nodes: Float32Array<ArrayBuffer>; nodeCount: number },
  count: number,
  boxOf: (leafIndex: number) => ArrayLike<number>,
  maxLeaf: number,
  maxDepth: number = BLAS_MAX_DEPTH,
): number {
  const { nodes, nodeCount } = tree;
  const words = new Uint32Array(nodes.buffer);
  expect(nodes.length).toBe(nodeCount * NODE_WORDS);
  const seenNodes = new Uint8Array(nodeCount),
    seen = new Uint8Array(count);
  let depth = 0;
  const stack: { node: number; parent: number; depth: number; box: number[] | undefined }[] = [
    { node: 0, parent: 0, depth: 1, box: undefined },
  ];
  while (stack.length > 0) {
    const entry = stack.pop()!;
    const base = entry.node * NODE_WORDS;
    if (seenNodes[entry.node]) throw new Error(`node ${entry.node} is reached twice`);
    seenNodes[entry.node] = 1;
    depth = Math.max(depth, entry.depth);
    if (words[base + PARENT] !== entry.parent)
      throw new Error(`node ${entry.node} has parent ${words[base + PARENT]}, not ${entry.parent}`);
    for (const [at, low, high] of [
      [LEFT, LEFT_MIN, LEFT_MAX],
      [RIGHT, RIGHT_MIN, RIGHT_MAX],
    ] as const) {
      if (nodes[base + low] === Math.fround(FAR)) continue;
      const box = [...nodes.subarray(base + low, base + low + 3), ...nodes.subarray(base + high, base + high + 3)];
      const inside = (inner: ArrayLike<number>, outer: ArrayLike<number>) =>
        [0, 1, 2].every((k) => inner[k]! >= outer[k]! && inner[3 + k]! <= outer[3 + k]!);
      if (entry.box && !inside(box, entry.box)) throw new Error(`a child of node ${entry.node} reaches out of it`);
      const reference = words[base + at]!;
      if ((reference & LEAF) === 0) {
        if (reference <= entry.node) throw new Error(`node ${entry.node} comes after its child ${reference}`);
        stack.push({ node: reference, parent: entry.node, depth: entry.depth + 1, box });
        continue;
      }
      if (leafCount(reference) > maxLeaf) throw new Error(`a leaf of ${leafCount(reference)}`);
      for (let i = leafFirst(reference); i < leafFirst(reference) + leafCount(reference); i++) {
        if (seen[i]) throw new Error(`primitive ${i} is in two leaves`);
        seen[i] = 1;
        if (!inside(boxOf(i), box)) throw new Error(`primitive ${i} reaches out of its leaf`);
      }
    }
  }
  expect(seen.every((s) => s === 1)).toBe(true);
  expect(seenNodes.every((s) => s === 1)).toBe(true);
  expect(depth).toBeLessThanOrEqual(maxDepth);
  return depth;
}

/** {@link checkStructure} for a BLAS. */
export function checkBlas(blas: Blas, mesh: TriangleMesh, maxLeaf = 4): number {
  const { positions, indices } = mesh;
  return checkStructure(
    blas,
    blas.triangleIndices.length,
    (i) => {
      const triangle = blas.triangleIndices[i]!;
      const corners = [0, 1, 2].map((c) => 3 * (indices ? indices[3 * triangle + c]! : 3 * triangle + c));
      const range = (pick: typeof Math.min) => [0, 1, 2].map((k) => pick(...corners.map((c) => positions[c + k]!)));
      return [...range(Math.min), ...range(Math.max)];
    },
    maxLeaf,
  );
}

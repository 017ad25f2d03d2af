import { expect, test } from 'vitest';
import { buildBlas, buildTlas } from '../src/index';
import { bvhStatistics, sahCost } from '../src/statistics';
import { FAR, LEAF, LEFT, LEFT_MIN, leafCount, NODE_WORDS, RIGHT, RIGHT_MIN } from '../src/layout';
import { affine, direction, randomNumbers, sphere, strewn } from './shapes';

test('the histograms are those of a walk through the tree (seed 86)', () => {
  for (const options of [{}, { maxLeafTriangles: 1 }, { maxLeafTriangles: 16 }]) {
    const mesh = strewn(700, 0.3, randomNumbers(86));
    const blas = buildBlas(mesh, options);
    const words = new Uint32Array(blas.nodes.buffer);
    const sizes: Record<number, number> = {},
      depths: Record<number, number> = {};
    const walk = (node: number, depth: number) => {
      for (const side of [LEFT, RIGHT]) {
        const reference = words[node * NODE_WORDS + side]!;
        if (reference < LEAF) walk(reference, depth + 1);
        else {
          sizes[leafCount(reference)] = (sizes[leafCount(reference)] ?? 0) + 1;
          depths[depth] = (depths[depth] ?? 0) + 1;
        }
      }
    };
    walk(0, 1);
    const s = bvhStatistics(blas);
    expect({ ...s.leafSizes }).toMatchObject(sizes);
    expect({ ...s.leafDepths }).toMatchObject(depths);
    expect(s.leafSizes.reduce((a, b) => a + b)).toBe(s.leaves);
    expect(s.leafDepths.reduce((a, b) => a + b)).toBe(s.leaves);
    expect([s.leafDepths.length - 1, s.nodes]).toEqual([s.depth, blas.nodeCount]);
    expect(s.leaves).toBe(s.nodes + 1);
    expect(s.leafSizes.reduce((sum, n, size) => sum + n * size, 0)).toBe(700);
  }
});

test('the cost is that of random lines, which the heuristic is about (seed 87)', () => {
  const mesh = strewn(300, 0.4, randomNumbers(87));
  const blas = buildBlas(mesh);
  const { nodes } = blas;
  const words = new Uint32Array(nodes.buffer);
  const random = randomNumbers(88);
  const enters = (o: readonly number[], d: readonly number[], boxes: ArrayLike<number>, low: number) => {
    let near = -Infinity,
      far = Infinity;
    for (let k = 0; k < 3; k++) {
      const a = (boxes[low + k]! - o[k]!) / d[k]!,
        b = (boxes[low + 4 + k]! - o[k]!) / d[k]!;
      near = Math.max(near, Math.min(a, b));
      far = Math.min(far, Math.max(a, b));
    }
    return near <= far;
  };
  // Evenly spread lines: through points of a disc across each direction. They meet convex bodies in proportion to their
  // surface.
  let met = 0,
    hit = 0,
    squares = 0;
  for (let i = 0; i < 20_000; i++) {
    const d = direction(random),
      a = direction(random);
    const along = a.reduce((sum, x, k) => sum + x * d[k]!, 0),
      flat = a.map((x, k) => x - along * d[k]!),
      length = Math.hypot(...flat);
    const r = 3 * Math.sqrt(random());
    const o = flat.map((x) => (r * x) / length);
    if (!enters(o, d, [...blas.bounds.min, 0, ...blas.bounds.max], 0)) continue;
    let own = 1;
    const stack = [0];
    while (stack.length > 0) {
      const node = stack.pop()!;
      for (const [side, low] of [
        [LEFT, LEFT_MIN],
        [RIGHT, RIGHT_MIN],
      ] as const) {
        if (!enters(o, d, nodes, node * NODE_WORDS + low)) continue;
        const reference = words[node * NODE_WORDS + side]!;
        if (reference < LEAF) stack.push(reference);
        own += reference < LEAF ? 1 : leafCount(reference);
      }
    }
    hit++;
    met += own;
    squares += own * own;
  }
  const error = Math.sqrt(squares / hit - (met / hit) ** 2) / Math.sqrt(hit);
  // Four standard errors, the seed is fixed.
  expect(Math.abs(met / hit - sahCost(blas))).toBeLessThan(4 * error);
});

test('of instances, of one triangle, of none', () => {
  const { bounds } = buildBlas(sphere(8));
  const random = randomNumbers(89);
  const tlas = buildTlas(Array.from({ length: 40 }, () => ({ bounds, transform: affine(random) })));
  expect(bvhStatistics(tlas).leafSizes.slice(0, 3)).toEqual([0, 40, 0]);
  expect(bvhStatistics(buildBlas({ positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]) }))).toMatchObject({
    sahCost: 2,
    depth: 1,
    nodes: 1,
    leaves: 1,
    leafDepths: [0, 1],
  });
  const none = buildBlas({ positions: new Float32Array(0) });
  expect(none.nodes[LEFT_MIN]).toBe(FAR);
  expect(bvhStatistics(none)).toMatchObject({ depth: 1, nodes: 1, leaves: 0 });
});

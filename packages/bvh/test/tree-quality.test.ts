import { expect, test } from 'vitest';
import { bestSplit } from '../src/builders/best';
import { buildBlas, type Blas, type TriangleMesh } from '../src/index';
import { refitBlas } from '../src/refit';
import { LEAF, LEFT, LEFT_MIN, leafCount, leafFirst, leafReference, NODE_WORDS, RIGHT, RIGHT_MIN } from '../src/layout';
import { endPointOverlap, siblingOverlap } from '../src/tree-quality';
import { direction, randomNumbers, sphere, strewn } from './shapes';
import { work } from './work';

/** Boxes below the root with the triangles in them and what each costs. */
function boxes(blas: Blas): { low: number; cost: number; triangles: Set<number> }[] {
  const words = new Uint32Array(blas.nodes.buffer);
  const list: { low: number; cost: number; triangles: Set<number> }[] = [];
  const below = (node: number): Set<number> => {
    const all = new Set<number>();
    for (const [side, low] of [
      [LEFT, LEFT_MIN],
      [RIGHT, RIGHT_MIN],
    ] as const) {
      const reference = words[node * NODE_WORDS + side]!;
      if (blas.nodes[node * NODE_WORDS + low]! > 1e38) continue;
      const triangles =
        reference < LEAF
          ? below(reference)
          : new Set(blas.triangleIndices.subarray(leafFirst(reference), leafFirst(reference) + leafCount(reference)));
      list.push({ low: node * NODE_WORDS + low, cost: reference < LEAF ? 1 : leafCount(reference), triangles });
      triangles.forEach((triangle) => all.add(triangle));
    }
    return all;
  };
  below(0);
  return list;
}

/** The end-point overlap by random points on the surface: mean and standard error. */
function sampled(
  blas: Blas,
  { positions: p, indices }: TriangleMesh & { indices: Uint32Array },
  seed: number,
  points: number,
): [number, number] {
  const random = randomNumbers(seed);
  const all = boxes(blas);
  const corner = (t: number, c: number, k: number) => p[3 * indices[3 * t + c]! + k]!;
  const areas = Array.from({ length: indices.length / 3 }, (_, t) => {
    const [e, f] = [1, 2].map((c) => [0, 1, 2].map((k) => corner(t, c, k) - corner(t, 0, k))) as [number[], number[]];
    return Math.hypot(e[1]! * f[2]! - e[2]! * f[1]!, e[2]! * f[0]! - e[0]! * f[2]!, e[0]! * f[1]! - e[1]! * f[0]!);
  });
  const total = areas.reduce((a, b) => a + b);
  let sum = 0,
    squares = 0;
  for (let i = 0; i < points; i++) {
    let pick = total * random(),
      triangle = 0;
    while (triangle < areas.length - 1 && (pick -= areas[triangle]!) > 0) triangle++;
    const root = Math.sqrt(random()),
      v = random() * root,
      u = root - v;
    const point = [0, 1, 2].map(
      (k) => (1 - u - v) * corner(triangle, 0, k) + u * corner(triangle, 1, k) + v * corner(triangle, 2, k),
    );
    let met = 0;
    for (const { low, cost, triangles } of all) {
      if (!triangles.has(triangle) && point.every((x, k) => x >= blas.nodes[low + k]! && x <= blas.nodes[low + 4 + k]!))
        met += cost;
    }
    sum += met;
    squares += met * met;
  }
  return [sum / points, Math.sqrt((squares / points - (sum / points) ** 2) / points)];
}

for (const [name, mesh, options] of [
  ['strewn triangles', strewn(200, 0.5, randomNumbers(81)), {}],
  ['long ones, single leaves', strewn(80, 2, randomNumbers(82)), { maxLeafTriangles: 1 }],
  ['a sphere', sphere(12), {}],
] as const) {
  test(`end-point overlap is what random points on the surface say: ${name} (seed 83)`, () => {
    const blas = buildBlas(mesh, options);
    const [mean, error] = sampled(blas, mesh, 83, 20_000);
    expect(mean).toBeGreaterThan(0.1);
    // Four standard errors: one false alarm in 16,000 runs, and the seed is fixed.
    expect(Math.abs(endPointOverlap(blas, mesh) - mean)).toBeLessThan(4 * error);
  });
}

test('needles in all directions, whole and cut: still what random points say (seed 90)', () => {
  const random = randomNumbers(90);
  const mesh = strewn(150, 0, random);
  for (let i = 0; i < 150; i++) {
    const along = direction(random),
      across = direction(random);
    for (let k = 0; k < 3; k++) {
      mesh.positions[9 * i + 3 + k]! += along[k]!;
      mesh.positions[9 * i + 6 + k]! += along[k]! + 0.01 * across[k]!;
    }
  }
  for (const options of [{}, { builder: bestSplit }]) {
    const blas = buildBlas(mesh, options);
    const [mean, error] = sampled(blas, mesh, 91, 20_000);
    expect(Math.abs(endPointOverlap(blas, mesh) - mean)).toBeLessThan(4 * error);
  }
});

test('boxes that lie apart do not overlap; two in one another do', () => {
  const row = {
    positions: Float32Array.from(
      { length: 9 * 8 },
      (_, i) => [0, 0, 0, 0.5, 0, 0.2, 0, 0.5, 0.1][i % 9]! + (i % 3 === 0 ? Math.floor(i / 9) : 0),
    ),
  };
  const blas = buildBlas(row, { maxLeafTriangles: 1 });
  expect([endPointOverlap(blas, row), siblingOverlap(blas)]).toEqual([0, 0]);
  // Computed on paper: a root with two leaves, each with one of two crossing squares' halves, boxes [0,2]³ and [1,3]×[0,2]².
  const nodes = new Float32Array(NODE_WORDS);
  nodes.set([0, 0, 0], LEFT_MIN);
  nodes.set([2, 2, 2], LEFT_MIN + 4);
  nodes.set([1, 0, 0], RIGHT_MIN);
  nodes.set([3, 2, 2], RIGHT_MIN + 4);
  new Uint32Array(nodes.buffer).set([leafReference(0, 1)], LEFT);
  new Uint32Array(nodes.buffer).set([leafReference(1, 1)], RIGHT);
  const mesh = { positions: new Float32Array([0, 0, 0, 2, 0, 0, 2, 2, 0, 1, 1, 1, 3, 1, 1, 3, 2, 1]) };
  const tree = {
    nodes,
    nodeCount: 1,
    triangleIndices: new Uint32Array([0, 1]),
    bounds: { min: new Float32Array(3), max: new Float32Array([3, 2, 2]) },
  };
  // Of the first triangle's area 2, what lies at x ≥ 1 is 1.5; of the second's area 1, what lies at x ≤ 2 is 0.25.
  expect(endPointOverlap(tree, mesh)).toBeCloseTo((1.5 + 0.25) / 3, 12);
  expect(siblingOverlap(tree)).toBeCloseTo((1 * 2 + 2 * 2 + 2 * 1) / (3 * 2 + 2 * 2 + 2 * 3), 12);
  expect(siblingOverlap(buildBlas({ positions: new Float32Array(0) }))).toBe(0);
  expect(endPointOverlap(buildBlas({ positions: new Float32Array(9) }), { positions: new Float32Array(9) })).toBe(0);
});

test('a worse tree overlaps more and costs rays more (seed 84)', () => {
  const mesh = strewn(1500, 0.1, randomNumbers(84));
  const good = buildBlas(mesh);
  // Half of the triangles change their leaves.
  const bad = buildBlas(mesh);
  for (let i = 0; i + 800 < 1500; i += 2)
    [bad.triangleIndices[i], bad.triangleIndices[i + 800]] = [bad.triangleIndices[i + 800]!, bad.triangleIndices[i]!];
  refitBlas(bad, mesh);
  expect(siblingOverlap(bad)).toBeGreaterThan(1.5 * siblingOverlap(good));
  expect(endPointOverlap(bad, mesh)).toBeGreaterThan(2 * endPointOverlap(good, mesh));
  expect(work(bad, mesh, 85)).toBeGreaterThan(2 * work(good, mesh, 85));
});

import { describe, expect, test } from 'vitest';
import { best, bestSplit } from '../../src/builders/best';
import { fast } from '../../src/builders/fast';
import { buildBlas, closestHit, type BlasOptions, type TriangleMesh } from '../../src/index';
import { refitBlas } from '../../src/refit';
import { bvhStatistics, sahCost } from '../../src/statistics';
import { boundDepth, finishDraft } from '../../src/builders/finish';
import { blasKey } from '../../src/cache';
import type { DraftTree } from '../../src/builders/draft';
import { bruteForce, direction, randomNumbers, sphere, strewn } from '../shapes';
import { checkBlas } from '../structure';

/** Long triangles in all directions: their boxes are next to empty. */
function slivers(count: number, random: () => number): { positions: Float32Array; indices: Uint32Array } {
  const mesh = strewn(count, 0, random);
  for (let i = 0; i < count; i++) {
    const along = direction(random),
      across = direction(random);
    for (let k = 0; k < 3; k++) {
      mesh.positions[9 * i + 3 + k]! += along[k]!;
      mesh.positions[9 * i + 6 + k]! += 0.5 * along[k]! + 0.01 * across[k]!;
    }
  }
  return mesh;
}

const odd: readonly (readonly [string, TriangleMesh])[] = [
  ['none', { positions: new Float32Array(0) }],
  ['one', { positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]) }],
  ['one of no extent', { positions: new Float32Array(9).fill(3) }],
  [
    '1,000 identical ones',
    { positions: Float32Array.from({ length: 9000 }, (_, i) => [0, 0, 0, 1, 0, 0, 0, 1, 0][i % 9]!) },
  ],
  ['1,000 points', { positions: new Float32Array(9000).fill(1) }],
  [
    'not finite ones among others',
    {
      positions: Float32Array.from({ length: 900 }, (_, i) =>
        i % 90 === 7 ? NaN : i % 90 === 30 ? Infinity : Math.sin(i * i),
      ),
    },
  ],
  [
    'sizes that double',
    {
      positions: Float32Array.from(
        { length: 1080 },
        (_, i) => [0, 0, 0, 1, 0, 0, 0, 1, 0][i % 9]! * 2 ** (Math.floor(i / 9) - 60),
      ),
    },
  ],
  [
    'in a plane',
    { positions: Float32Array.from({ length: 900 }, (_, i) => (i % 3 === 1 ? 0 : Math.cos(i * i * 0.7))) },
  ],
  ['as large as floats go', { positions: Float32Array.from({ length: 900 }, (_, i) => 3e38 * Math.cos(i * i)) }],
];

for (const [name, options] of [
  ['fast', { builder: fast }],
  ['best', { builder: best }],
  ['best-split', { builder: bestSplit }],
] as readonly (readonly [string, BlasOptions])[]) {
  describe(name, () => {
    test('every triangle is inside all boxes above it, in leaves no larger than asked for (seed 1)', () => {
      const random = randomNumbers(1);
      for (const count of [1, 2, 3, 4, 5, 17, 100, 3000]) {
        for (const maxLeafTriangles of [1, 4, 16]) {
          const mesh = strewn(count, 0.3, random);
          const blas = buildBlas(mesh, { ...options, maxLeafTriangles });
          if (name === 'best-split') {
            // Pieces are smaller than their triangles; with whole boxes again, all must hold.
            expect(new Set(blas.triangleIndices).size).toBe(count);
            refitBlas(blas, mesh);
          } else expect(blas.triangleIndices.length).toBe(count);
          checkBlas(blas, mesh, maxLeafTriangles);
        }
      }
    });

    test('finds what brute force finds, among blobs and slivers (seeds 2, 3)', () => {
      for (const [seed, make] of [
        [2, (r: () => number) => strewn(600, 0.3, r)],
        [3, (r: () => number) => slivers(600, r)],
      ] as const) {
        const random = randomNumbers(seed);
        const mesh = make(random);
        const blas = buildBlas(mesh, options);
        let hits = 0;
        for (let i = 0; i < 1000; i++) {
          const origin = direction(random).map((x) => 3 * x),
            target = [0, 1, 2].map(() => 1.6 * random() - 0.8);
          const ray = { origin, direction: target.map((x, k) => x - origin[k]!) };
          const expected = bruteForce(mesh, ray.origin, ray.direction),
            hit = closestHit(blas, mesh, ray);
          expect(hit?.triangle).toBe(expected?.triangle);
          if (expected) {
            hits++;
            expect(hit!.t).toBeCloseTo(expected.t, 9);
          }
        }
        expect(hits).toBeGreaterThan(100);
      }
    });

    test('no ray slips through a closed mesh (seed 4)', () => {
      const random = randomNumbers(4);
      for (const [radius, center] of [
        [1, [0, 0, 0]],
        [0.001, [0.5, 0.3, 0.1]],
        [10000, [3000, 0, 0]],
      ] as const) {
        const mesh = sphere(32, radius, center);
        const blas = buildBlas(mesh, options);
        for (let i = 0; i < 1000; i++) {
          // Through vertices, edges and elsewhere.
          const at = 3 * Math.floor(random() * (mesh.indices.length / 3)),
            [a, b, c] = [0, 1, 2].map((k) => 3 * mesh.indices[at + k]!) as [number, number, number];
          const u = i % 3 === 0 ? 0 : random(),
            v = i % 3 === 2 ? (1 - u) * random() : 0;
          const origin = direction(random).map((x, k) => 0.3 * radius * x + center[k]!);
          const point = [0, 1, 2].map(
            (k) => (1 - u - v) * mesh.positions[a + k]! + u * mesh.positions[b + k]! + v * mesh.positions[c + k]!,
          );
          expect(closestHit(blas, mesh, { origin, direction: point.map((x, k) => x - origin[k]!) })).toBeDefined();
        }
      }
    });

    test('is deterministic, also after other builds', () => {
      const mesh = strewn(5000, 0.1, randomNumbers(7));
      const first = buildBlas(mesh, options);
      buildBlas(sphere(40), options);
      expect(buildBlas(mesh, options)).toEqual(first);
    });

    for (const [what, mesh] of odd) {
      test(`builds over ${what}`, () => {
        const blas = buildBlas(mesh, options);
        if (name === 'best-split' && blas.triangleIndices.length > 0) refitBlas(blas, mesh);
        checkBlas(blas, mesh);
      });
    }
  });
}

test('builders in the order of what they give: surface area cost', () => {
  for (const mesh of [sphere(64), strewn(5000, 0.2, randomNumbers(8)), slivers(5000, randomNumbers(9))]) {
    const [quick, balanced, b] = ([fast, 'balanced', best] as const).map((builder) =>
      sahCost(buildBlas(mesh, { builder })),
    ) as [number, number, number];
    expect(balanced).toBeLessThan(quick);
    expect(b).toBeLessThan(0.99 * balanced);
  }
});

test('a cache distinguishes builders', async () => {
  const mesh = sphere(8);
  const keys = await Promise.all(
    [{}, { builder: fast }, { builder: best }, { builder: bestSplit }].map((options) => blasKey(mesh, options)),
  );
  expect(new Set(keys).size).toBe(4);
});

test('pieces of triangles cut the cost of slivers, and are not made of a smooth mesh', () => {
  const thin = slivers(20_000, randomNumbers(9));
  const split = buildBlas(thin, { builder: bestSplit });
  expect(sahCost(split)).toBeLessThan(0.8 * sahCost(buildBlas(thin, { builder: best })));
  expect(split.triangleIndices.length).toBeLessThan(2.1 * 20_000);
  const smooth = sphere(96);
  expect(buildBlas(smooth, { builder: bestSplit }).triangleIndices.length).toBeLessThan(
    1.05 * (smooth.indices.length / 3),
  );
});

test('no triangle is twice in a leaf', () => {
  const mesh = slivers(3000, randomNumbers(10));
  const blas = buildBlas(mesh, { builder: bestSplit, maxLeafTriangles: 16 });
  const { nodes, nodeCount, triangleIndices } = blas;
  const words = new Uint32Array(nodes.buffer);
  for (let node = 0; node < nodeCount; node++) {
    for (const reference of [words[16 * node + 3]!, words[16 * node + 7]!]) {
      if (reference < 0x80000000) continue;
      const first = reference & 0x7ffffff,
        leaf = triangleIndices.subarray(first, first + ((reference >>> 27) & 15) + 1);
      expect(new Set(leaf).size).toBe(leaf.length);
    }
  }
});

test('a draft that is a single long chain is made flat enough, the rest stays', () => {
  const n = 300,
    places = 2 * n - 1;
  // Node n + i has item i and node n + i + 1 under it.
  const tree: DraftTree = {
    itemCount: n,
    boxes: new Float32Array(6 * places),
    areas: new Float32Array(places),
    parents: new Int32Array(places).fill(-1),
    children: new Int32Array(2 * places),
  };
  for (let i = 0; i < n; i++) for (let k = 0; k < 6; k++) tree.boxes[6 * i + k] = i + (k > 2 ? 1 : 0);
  for (let i = n - 2; i >= 0; i--) {
    const node = n + i,
      other = i === n - 2 ? n - 1 : node + 1;
    tree.children.set([i, other], 2 * node);
    tree.parents[i] = tree.parents[other] = node;
    for (let k = 0; k < 3; k++) {
      tree.boxes[6 * node + k] = i;
      tree.boxes[6 * node + 3 + k] = n;
    }
    tree.areas[node] = 3 * (n - i) ** 2;
  }
  for (const _ of boundDepth(tree, 20));
  const depth = (place: number): number =>
    place < n ? 0 : 1 + Math.max(depth(tree.children[2 * place]!), depth(tree.children[2 * place + 1]!));
  expect(depth(n)).toBeLessThanOrEqual(20);
  // The first items keep their places.
  expect([tree.children[2 * n], tree.children[2 * (n + 5)]]).toEqual([0, 5]);
  const steps = finishDraft(
    tree,
    {
      boxes: tree.boxes,
      triangles: Uint32Array.from({ length: n }, (_, i) => i),
      count: n,
      bounds: new Float64Array(6),
    },
    1,
    20,
  );
  let step = steps.next();
  while (!step.done) step = steps.next();
  expect(bvhStatistics(step.value).depth).toBeLessThanOrEqual(20);
  expect([...step.value.triangleIndices].sort((a, b) => a - b)).toEqual(Array.from({ length: n }, (_, i) => i));
});

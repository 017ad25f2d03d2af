import { expect, test } from 'vitest';
import { allHits, allHitsBatch, allHitsInstances, forEachHit, forEachHitInstances } from '../../src/cpu/all-hits';
import { buildBlas, buildTlas, BvhError, closestHit } from '../../src/index';
import { cutInTwo } from '../cut';
import { affine, baked, bruteForceAll, direction, randomNumbers, sphere, strewn } from '../shapes';

for (const seed of [211, 212, 213]) {
  test(`allHits finds what brute force finds, in order (seed ${seed})`, () => {
    const random = randomNumbers(seed);
    const mesh = strewn(300, [0.3, 1, 3][seed % 3]!, random);
    const blas = buildBlas(mesh, { maxLeafTriangles: [1, 4, 16][seed % 3]! });
    const count = 300;
    const rays = new Float64Array(8 * count);
    const expected = Array.from({ length: count }, (_, i) => {
      const origin = [0, 1, 2].map(() => 4 * random() - 2);
      rays.set([...origin, random() - 0.5, ...origin.map((x) => random() - 0.5 - x), 1 + 2 * random()], 8 * i);
      return bruteForceAll(mesh, origin, rays.subarray(8 * i + 4, 8 * i + 7), rays[8 * i + 3], rays[8 * i + 7]).sort(
        (a, b) => a.t - b.t,
      );
    });
    let total = 0;
    for (let i = 0; i < count; i++) {
      const hits = allHits(blas, mesh, {
        origin: rays.subarray(8 * i, 8 * i + 3),
        direction: rays.subarray(8 * i + 4, 8 * i + 7),
        tMin: rays[8 * i + 3]!,
        tMax: rays[8 * i + 7]!,
      });
      expect(hits.map(({ triangle }) => triangle)).toEqual(expected[i]!.map(({ triangle }) => triangle));
      hits.forEach((hit, k) => {
        expect(hit.t).toBeCloseTo(expected[i]![k]!.t, 8);
        expect(hit.u).toBeCloseTo(expected[i]![k]!.u, 6);
        expect(hit.v).toBeCloseTo(expected[i]![k]!.v, 6);
      });
      total += hits.length;
    }
    expect(total).toBeGreaterThan(100);

    const out = {
      starts: new Uint32Array(count + 1),
      triangle: new Uint32Array(total),
      t: new Float64Array(total),
      u: new Float64Array(total),
      v: new Float64Array(total),
    };
    expect(allHitsBatch(blas, mesh, rays, out)).toBe(total);
    expected.forEach((hits, i) => {
      const found = Array.from({ length: out.starts[i + 1]! - out.starts[i]! }, (_, k) => out.starts[i]! + k).sort(
        (a, b) => out.t[a]! - out.t[b]!,
      );
      expect(found.map((k) => out.triangle[k])).toEqual(hits.map(({ triangle }) => triangle));
      found.forEach((k, n) => expect(out.u[k]! + out.v[k]!).toBeCloseTo(hits[n]!.u + hits[n]!.v, 6));
    });
    // Too short: the number says how long.
    expect(allHitsBatch(blas, mesh, rays, { starts: out.starts, triangle: new Uint32Array(3) })).toBe(total);
    expect(() => allHitsBatch(blas, mesh, rays, { starts: new Uint32Array(count), triangle: out.triangle })).toThrow(
      BvhError,
    );
  });
}

test('all hits of instances, mirrored and sheared ones too (seed 214)', () => {
  const random = randomNumbers(214);
  const mesh = sphere(10),
    blas = buildBlas(mesh);
  const placed = Array.from({ length: 25 }, () => ({ mesh, blas, transform: affine(random, 2) }));
  const tlas = buildTlas(placed.map(({ transform }) => ({ bounds: blas.bounds, transform })));
  const inWorld = placed.map(({ transform }) => baked(mesh, transform));
  let total = 0;
  for (let i = 0; i < 200; i++) {
    const origin = direction(random).map((x) => 4 * x);
    const ray = { origin, direction: origin.map((x) => 2 * (random() - 0.5) - x) };
    const expected = inWorld
      .flatMap((part, instance) => bruteForceAll(part, ray.origin, ray.direction).map((hit) => ({ ...hit, instance })))
      .sort((a, b) => a.t - b.t);
    const hits = allHitsInstances(tlas, placed, ray);
    expect(hits.map(({ instance, triangle }) => [instance, triangle])).toEqual(
      expected.map(({ instance, triangle }) => [instance, triangle]),
    );
    total += hits.length;
  }
  expect(total).toBeGreaterThan(400);
});

test('a visitor can stop, ask further questions, and throw', () => {
  const mesh = sphere(16);
  const blas = buildBlas(mesh);
  const ray = { origin: [3, 0.1, 0.2], direction: [-1, 0.01, 0.02] };
  const reported: number[] = [];
  forEachHit(blas, mesh, ray, (t, u, v, triangle) => {
    // The query within is the same ray: it must not disturb the one around it.
    reported.push(triangle, closestHit(blas, mesh, { ...ray, tMin: t })?.triangle ?? -1);
  });
  expect(reported).toHaveLength(4);
  expect(new Set(reported)).toEqual(new Set([...allHits(blas, mesh, ray).map(({ triangle }) => triangle), -1]));
  let calls = 0;
  forEachHit(blas, mesh, ray, () => ++calls === 1);
  expect(calls).toBe(1);
  const tlas = buildTlas(
    [0, 10, 20].map((x) => ({ bounds: blas.bounds, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, 0, 0, 1] })),
  );
  const parts = [0, 1, 2].map(() => ({ blas, mesh }));
  forEachHitInstances(tlas, parts, ray, () => ++calls === 3);
  expect(calls).toBe(3);
  expect(() =>
    forEachHit(blas, mesh, ray, () => {
      throw new RangeError('mine');
    }),
  ).toThrow('mine');
  expect(allHits(blas, mesh, ray)).toHaveLength(2);
});

test('a tree of one leaf reports each triangle once', () => {
  const mesh = { positions: new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0, -1, -1, 0, 3, -1, 0, -1, 3, 0]) };
  const blas = buildBlas(mesh, { maxLeafTriangles: 16 });
  expect(blas.nodeCount).toBe(1);
  for (const z of [1, 1e30])
    expect(
      allHits(blas, mesh, { origin: [0.1, 0.1, z], direction: [0, 0, -1] }).map(({ triangle }) => triangle),
    ).toEqual([0, 1]);
  expect(allHits(blas, mesh, { origin: [-1, -1, -1], direction: [1, 1, 1] })).toHaveLength(2);
  const one = { positions: mesh.positions.subarray(0, 9) };
  expect(allHits(buildBlas(one), one, { origin: [-1, -1, -1], direction: [1, 1, 1] })).toHaveLength(1);
});

test('triangles that are in several leaves are reported once a ray, and once an instance (seed 215)', () => {
  const random = randomNumbers(215);
  const mesh = strewn(200, 1, random);
  const blas = cutInTwo(mesh);
  expect(blas.triangleIndices.length).toBe(400);
  const rays = new Float64Array(8 * 200);
  let total = 0;
  for (let i = 0; i < 200; i++) {
    const origin = direction(random).map((x) => 3 * x);
    const ray = { origin, direction: origin.map((x) => random() - 0.5 - x) };
    rays.set([...origin, 0, ...ray.direction, 1e30], 8 * i);
    const expected = bruteForceAll(mesh, ray.origin, ray.direction)
      .sort((a, b) => a.t - b.t)
      .map(({ triangle }) => triangle);
    expect(allHits(blas, mesh, ray).map(({ triangle }) => triangle)).toEqual(expected);
    // Both instances are the same one.
    const tlas = buildTlas(
      [0, 1].map(() => ({ bounds: blas.bounds, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] })),
    );
    expect(
      allHitsInstances(
        tlas,
        [
          { blas, mesh },
          { blas, mesh },
        ],
        ray,
      ),
    ).toHaveLength(2 * expected.length);
    total += expected.length;
  }
  expect(total).toBeGreaterThan(500);
  expect(allHitsBatch(blas, mesh, rays, { starts: new Uint32Array(201), triangle: new Uint32Array(0) })).toBe(total);
});

import { expect, test } from 'vitest';
import { anyHit, buildBlas, buildTlas, BvhError, closestHit, closestHitInstances } from '../../src/index';
import { anyHitBatch, anyHitBatchInstances, closestHitBatch, closestHitBatchInstances } from '../../src/cpu/batch';
import { affine, bruteForceAll, direction, randomNumbers, sphere, strewn } from '../shapes';

/** Rays towards the middle with intervals that cut some of the hits off. */
function someRays(count: number, random: () => number): Float64Array {
  const rays = new Float64Array(8 * count);
  for (let i = 0; i < count; i++) {
    const origin = direction(random).map((x) => 3 * x);
    rays.set(
      [
        ...origin,
        i % 3 === 0 ? random() : 0,
        ...origin.map((x) => (random() - 0.5 - x) * 0.7),
        i % 4 === 0 ? 1 + random() : 1e30,
      ],
      8 * i,
    );
  }
  return rays;
}

for (const seed of [201, 202]) {
  test(`many rays at once find what brute force finds (seed ${seed})`, () => {
    const random = randomNumbers(seed);
    const mesh = strewn(300, 0.5, random);
    const blas = buildBlas(mesh);
    const rays = someRays(500, random);
    const out = {
      t: new Float64Array(501).fill(7),
      u: new Float64Array(500),
      v: new Float64Array(500),
      triangle: new Int32Array(500),
    };
    const any = new Uint8Array(500).fill(9);
    closestHitBatch(blas, mesh, rays, out);
    anyHitBatch(blas, mesh, rays, any);
    let hits = 0;
    for (let i = 0; i < 500; i++) {
      const [nearest] = bruteForceAll(
        mesh,
        rays.subarray(8 * i, 8 * i + 3),
        rays.subarray(8 * i + 4, 8 * i + 7),
        rays[8 * i + 3],
        rays[8 * i + 7],
      ).sort((a, b) => a.t - b.t);
      expect(out.triangle[i]).toBe(nearest?.triangle ?? -1);
      expect(any[i]).toBe(nearest ? 1 : 0);
      if (!nearest) {
        expect(out.t[i]).toBe(Infinity);
        continue;
      }
      hits++;
      expect(out.t[i]).toBeCloseTo(nearest.t, 9);
      expect(out.u[i]).toBeCloseTo(nearest.u, 7);
      expect(out.v[i]).toBeCloseTo(nearest.v, 7);
    }
    expect(hits).toBeGreaterThan(200);
    expect(out.t[500]).toBe(7);
  });
}

test('many rays through instances: the same as one at a time (seed 203)', () => {
  const random = randomNumbers(203);
  const meshes = [sphere(12), strewn(80, 0.4, random)];
  const parts = meshes.map((mesh) => ({ mesh, blas: buildBlas(mesh) }));
  const placed = Array.from({ length: 20 }, (_, i) => ({ ...parts[i % 2]!, transform: affine(random, 2) }));
  const tlas = buildTlas(placed.map(({ blas, transform }) => ({ bounds: blas.bounds, transform })));
  const rays = someRays(400, random);
  const out = { t: new Float64Array(400), triangle: new Int32Array(400), instance: new Int32Array(400) };
  const any = new Uint8Array(400);
  closestHitBatchInstances(tlas, placed, rays, out);
  anyHitBatchInstances(tlas, placed, rays, any);
  const seen = new Set<number>();
  for (let i = 0; i < 400; i++) {
    const hit = closestHitInstances(tlas, placed, {
      origin: rays.subarray(8 * i, 8 * i + 3),
      direction: rays.subarray(8 * i + 4, 8 * i + 7),
      tMin: rays[8 * i + 3]!,
      tMax: rays[8 * i + 7]!,
    });
    expect([out.triangle[i], out.instance[i], out.t[i], any[i]]).toEqual([
      hit?.triangle ?? -1,
      hit?.instance ?? -1,
      hit?.t ?? Infinity,
      hit ? 1 : 0,
    ]);
    seen.add(out.instance[i]!);
  }
  expect(seen.size).toBeGreaterThan(10);
});

test('nothing is kept of the ray before, nor of a query that asks further ones', () => {
  const mesh = sphere(8);
  const blas = buildBlas(mesh);
  const hit = { origin: [0, 0, 3], direction: [0.01, 0.02, -1] },
    miss = { origin: [0, 0, 3], direction: [0, 0, 1] };
  const first = closestHit(blas, mesh, hit);
  expect(anyHit(blas, mesh, miss)).toBe(false);
  expect(closestHit(blas, mesh, hit)).toEqual(first);
});

test('arrays of a wrong length are refused, an empty tree is missed', () => {
  const mesh = { positions: new Float32Array(0) };
  const blas = buildBlas(mesh);
  const out = { t: new Float32Array(1), triangle: new Int32Array([5]) };
  closestHitBatch(blas, mesh, Float32Array.of(0, 0, 0, 0, 1, 0, 0, 1e30), out);
  expect([out.t[0], out.triangle[0]]).toEqual([Infinity, -1]);
  const code = (f: () => unknown) => {
    try {
      f();
    } catch (error) {
      return error instanceof BvhError && error.code;
    }
    return undefined;
  };
  expect(code(() => closestHitBatch(blas, mesh, new Float32Array(9), out))).toBe('bvh/batch');
  expect(code(() => closestHitBatch(blas, mesh, new Float32Array(16), out))).toBe('bvh/batch');
  expect(code(() => anyHitBatch(blas, mesh, new Float32Array(16), new Uint8Array(1)))).toBe('bvh/batch');
});

import { expect, test } from 'vitest';
import {
  closestPoint,
  closestPointBatch,
  closestPointBatchInstances,
  closestPointInstances,
} from '../../src/cpu/distance';
import { buildBlas, buildTlas, BvhError, type TriangleMesh } from '../../src/index';
import { affine, baked, randomNumbers, sphere, strewn } from '../shapes';
import { cornersOf, distanceTo } from './brute-shapes';

/** Checks that a found point is on its triangle, at the distance said. */
function checkFound(
  mesh: TriangleMesh,
  p: readonly number[],
  found: { distance: number; point: readonly number[]; triangle: number; u: number; v: number },
): void {
  const [a, b, c] = cornersOf(mesh)[found.triangle]!;
  expect(Math.min(found.u, found.v, 1 - found.u - found.v)).toBeGreaterThanOrEqual(-1e-12);
  for (let k = 0; k < 3; k++)
    expect((1 - found.u - found.v) * a[k]! + found.u * b[k]! + found.v * c[k]!).toBeCloseTo(found.point[k]!, 10);
  expect(Math.hypot(...found.point.map((x, k) => x - p[k]!))).toBeCloseTo(found.distance, 10);
}

for (const seed of [221, 222, 223]) {
  test(`closestPoint finds the distance that brute force finds, one at a time and in batches (seed ${seed})`, () => {
    const random = randomNumbers(seed);
    const mesh = strewn(300, [0.05, 0.4, 2][seed % 3]!, random);
    const blas = buildBlas(mesh);
    const corners = cornersOf(mesh);
    const count = 200,
      maxDistance = 0.3;
    const points = Float64Array.from({ length: 3 * count }, () => 4 * random() - 2);
    const out = {
      distance: new Float64Array(count),
      triangle: new Int32Array(count),
      point: new Float64Array(3 * count),
      u: new Float64Array(count),
      v: new Float64Array(count),
    };
    closestPointBatch(blas, mesh, points, out, { maxDistance });
    let within = 0;
    for (let i = 0; i < count; i++) {
      const p = [points[3 * i]!, points[3 * i + 1]!, points[3 * i + 2]!] as const;
      const expected = Math.min(...corners.map((triangle) => distanceTo(triangle, p)));
      const found = closestPoint(blas, mesh, p)!;
      expect(found.distance).toBeCloseTo(expected, 12);
      checkFound(mesh, p, found);
      if (expected < maxDistance) {
        within++;
        expect([out.distance[i], out.triangle[i], out.u[i], out.v[i], ...out.point.subarray(3 * i, 3 * i + 3)]).toEqual(
          [found.distance, found.triangle, found.u, found.v, ...found.point],
        );
      } else {
        expect([out.distance[i], out.triangle[i]]).toEqual([Infinity, -1]);
        expect(closestPoint(blas, mesh, p, { maxDistance })).toBeUndefined();
      }
    }
    expect(within).toBeGreaterThan(5);
  });
}

for (const seed of [224, 225]) {
  test(`instances: distances are the world's under shear, mirrors and uneven scales (seed ${seed})`, () => {
    const random = randomNumbers(seed);
    const meshes = [sphere(8), strewn(40, 0.5, random)];
    const parts = meshes.map((mesh) => ({ mesh, blas: buildBlas(mesh) }));
    const placed = Array.from({ length: 20 }, (_, i) => {
      const transform = affine(random, 3);
      // Some are flat as cards, some long as needles.
      const thin = [1, 0.01, 20][i % 3]!;
      for (let r = 0; r < 3; r++) transform[4 * (i % 2) + r]! *= thin;
      return { ...parts[i % 2]!, transform };
    });
    const tlas = buildTlas(placed.map(({ blas, transform }) => ({ bounds: blas.bounds, transform })));
    const inWorld = placed.map(({ mesh, transform }) => baked(mesh, transform));
    const corners = inWorld.map(cornersOf);
    const points = Float64Array.from({ length: 3 * 80 }, () => 12 * random() - 6);
    const out = { distance: new Float64Array(80), instance: new Int32Array(80) };
    closestPointBatchInstances(tlas, placed, points, out);
    const seen = new Set<number>();
    for (let i = 0; i < 80; i++) {
      const p = [points[3 * i]!, points[3 * i + 1]!, points[3 * i + 2]!] as const;
      const distances = corners.map((triangles) => Math.min(...triangles.map((triangle) => distanceTo(triangle, p))));
      const expected = Math.min(...distances);
      const found = closestPointInstances(tlas, placed, p)!;
      expect(found.distance).toBeCloseTo(expected, 9);
      expect(distances[found.instance]).toBeCloseTo(expected, 9);
      checkFound(inWorld[found.instance]!, p, found);
      expect([out.distance[i], out.instance[i]]).toEqual([found.distance, found.instance]);
      expect(closestPointInstances(tlas, placed, p, { maxDistance: expected * 0.999 })).toBeUndefined();
      seen.add(found.instance);
    }
    expect(seen.size).toBeGreaterThan(3);
  });
}

test('degenerate triangles are the segments and points they are', () => {
  const shapes: [number[], number[], number][] = [
    [[1, 1, 1, 1, 1, 1, 1, 1, 1], [1, 1, 4], 3],
    [[0, 0, 0, 1, 0, 0, 3, 0, 0], [2, 2, 0], 2],
    [[3, 0, 0, 0, 0, 0, 1, 0, 0], [-3, 4, 0], 5],
    [[0, 0, 0, 0, 0, 0, 0, 2, 0], [1, 1, 0], 1],
    // A sliver whose area is all rounding.
    [[0, 0, 0, 1, 1e-9, 0, 0.5, 1e-9, 0], [0.75, 0, 2], 2],
  ];
  for (const [positions, p, expected] of shapes) {
    const mesh = { positions: new Float32Array(positions) };
    const found = closestPoint(buildBlas(mesh), mesh, p)!;
    expect(found.distance).toBeCloseTo(expected, 8);
    checkFound(mesh, p, found);
  }
});

test('on the mesh, in an empty tree, with wrong arrays', () => {
  const mesh = sphere(8);
  const blas = buildBlas(mesh);
  const on = closestPoint(blas, mesh, mesh.positions.subarray(9, 12))!;
  expect(on.distance).toBe(0);
  expect(closestPoint(blas, mesh, [NaN, 0, 0])).toBeUndefined();
  const none = { positions: new Float32Array(0) };
  expect(closestPoint(buildBlas(none), none, [0, 0, 0])).toBeUndefined();
  expect(closestPointInstances(buildTlas([]), [], [0, 0, 0])).toBeUndefined();
  const distance = new Float32Array(2);
  expect(() => closestPointBatch(blas, mesh, new Float32Array(7), { distance })).toThrow(BvhError);
  expect(() => closestPointBatch(blas, mesh, new Float32Array(9), { distance })).toThrow(/distance has 2/);
  expect(() => closestPointBatch(blas, mesh, new Float32Array(6), { distance, point: new Float32Array(5) })).toThrow(
    /point has 5 entries; 2 points need 6/,
  );
});

import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { closestHitInstances } from '../../src/index';
import { widenBlas, widenTlas } from '../../src/wide/index';
import { bvhTraversal } from '../../src/wgsl/wide/index';
import { trace as traceIn, upload, type Layout, type Placed } from '../gpu-trace';
import { affine, direction, randomNumbers, sphere, strewn } from '../shapes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

const layout: Layout = { blas: widenBlas, tlas: widenTlas, traversal: bvhTraversal };
const trace = (placed: readonly Placed[], rays: Float32Array<ArrayBuffer>, accept?: string) =>
  traceIn(device, layout, placed, rays, accept);

for (const seed of [51, 52]) {
  test(`WGSL and CPU find the same hits in instances with shear and mirrors (seed ${seed})`, async () => {
    const random = randomNumbers(seed);
    const meshes = [sphere(16), strewn(200, 0.4, random)];
    const placed = Array.from({ length: 12 }, (_, i) => ({ mesh: meshes[i % 2]!, transform: affine(random, 2) }));
    const rays = new Float32Array(8 * 1024);
    for (let i = 0; i < 1024; i++) {
      const origin = direction(random).map((x) => 4 * x);
      const length = 0.2 + 3 * random();
      rays.set([...origin, 0, ...origin.map((x) => (3 * (random() - 0.5) - x) * length), 1e30], 8 * i);
    }
    const hits = await trace(placed, rays);
    const { parts, tlas } = upload(placed, layout);
    let found = 0,
      other = 0;
    hits.forEach((hit, i) => {
      const ray = { origin: rays.subarray(8 * i, 8 * i + 3), direction: rays.subarray(8 * i + 4, 8 * i + 7) };
      const expected = closestHitInstances(tlas, parts, ray);
      expect(hit.any).toBe(hit.instance !== 0xffffffff);
      if (expected && hit.instance !== 0xffffffff) {
        found++;
        expect(Math.abs(hit.t - expected.t)).toBeLessThan(2e-5 * expected.t);
        if (hit.instance === expected.instance && hit.triangle === expected.triangle) {
          expect(Math.abs(hit.u - expected.u)).toBeLessThan(1e-3);
          expect(Math.abs(hit.v - expected.v)).toBeLessThan(1e-3);
        } else other++;
      } else if (expected || hit.instance !== 0xffffffff) other++;
    });
    expect(found).toBeGreaterThan(300);
    // Rays within rounding of an edge may take the neighbour, or pass a silhouette.
    expect(other).toBeLessThanOrEqual(3);
  });
}

test('no ray leaks through vertices and edges of a closed mesh, small, far and large (seed 53)', async () => {
  const random = randomNumbers(53);
  for (const [radius, center] of [
    [1, [0, 0, 0]],
    [0.001, [0.5, 0.3, 0.1]],
    [10000, [3000, 0, 0]],
  ] as const) {
    const mesh = sphere(32, radius, center);
    const list: number[] = [];
    for (let i = 0; i < mesh.indices.length; i += 3) {
      for (const weight of [0, 0.5, random()]) {
        const [a, b] = [3 * mesh.indices[i]!, 3 * mesh.indices[i + 1]!];
        const origin = direction(random).map((x, k) => Math.fround(0.3 * radius * x + center[k]!));
        list.push(
          ...origin,
          0,
          ...[0, 1, 2].map((k) => (1 - weight) * mesh.positions[a + k]! + weight * mesh.positions[b + k]! - origin[k]!),
          3e38,
        );
      }
    }
    const hits = await trace([{ mesh, transform: identity }], new Float32Array(list));
    expect(hits.filter(({ instance }) => instance === 0xffffffff)).toHaveLength(0);
    expect(hits.every(({ any, u, v }) => any && u >= 0 && v >= 0 && u + v <= 1.000001)).toBe(true);
  }
});

test('weights of hits on thin triangles lie within, and t is that of the point they name (seed 55)', async () => {
  const random = randomNumbers(55);
  const count = 300;
  const positions = new Float32Array(9 * count);
  const list: number[] = [];
  for (let i = 0; i < count; i++) {
    const a = [0, 1, 2].map(() => 2 * random() - 1),
      along = direction(random),
      across = direction(random);
    for (let k = 0; k < 3; k++)
      for (let c = 0; c < 3; c++)
        positions[9 * i + 3 * c + k] = a[k]! + [0, 1, 0.4][c]! * along[k]! + [0, 0, 1e-4][c]! * across[k]!;
    // At points of the edges, where weights are cut off.
    for (let n = 0; n < 8; n++) {
      const corner = n % 3,
        s = random();
      const target = [0, 1, 2].map(
        (k) => (1 - s) * positions[9 * i + 3 * corner + k]! + s * positions[9 * i + 3 * ((corner + 1) % 3) + k]!,
      );
      const origin = direction(random).map((x) => Math.fround(8 * x));
      list.push(...origin, 0, ...target.map((x, k) => x - origin[k]!), 3e38);
    }
  }
  const rays = new Float32Array(list);
  const hits = await trace([{ mesh: { positions }, transform: identity }], rays);
  let found = 0;
  hits.forEach(({ t, u, v, triangle, instance }, i) => {
    if (instance === 0xffffffff) return;
    found++;
    expect(Math.min(u, v, 1 - u - v)).toBeGreaterThan(-1e-6);
    // Along the ray the point lies where t says, to the rounding of coordinates of 8 and the share of the length that
    // the rounding of a thin triangle's weights is; but the latter moves the point across the ray, not along it.
    const o = rays.subarray(8 * i, 8 * i + 3),
      d = rays.subarray(8 * i + 4, 8 * i + 7);
    const p = [0, 1, 2].map(
      (k) =>
        (1 - u - v) * positions[9 * triangle + k]! +
        u * positions[9 * triangle + 3 + k]! +
        v * positions[9 * triangle + 6 + k]! -
        o[k]!,
    );
    const length = Math.hypot(...d),
      along = p.reduce((sum, x, k) => sum + x * d[k]!, 0) / length;
    expect(Math.abs(along - t * length)).toBeLessThan(8 * 16 * 2 ** -24);
  });
  expect(found).toBeGreaterThan(600);
});

test('the interval is open, axis-parallel and tiny directions work', async () => {
  const mesh = { positions: new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]) };
  const down = (tMin: number, tMax: number, z = 2, length = 1) => [0, 0, z, tMin, 0, 0, -length, tMax];
  const hits = await trace(
    [{ mesh, transform: identity }],
    new Float32Array([
      ...down(0, 1e30),
      ...down(2, 1e30),
      ...down(0, 2),
      ...down(0, 2.001),
      ...down(0, 3e38, 2, 1e-15),
      ...down(0, 3e38, -2),
      0,
      0,
      2,
      0,
      1,
      0,
      0,
      1e30,
    ]),
  );
  expect(hits.map(({ instance }) => instance === 0)).toEqual([true, false, false, true, true, false, false]);
  expect(hits[0]!.t).toBeCloseTo(2, 6);
  expect(hits[4]!.t / 2e15).toBeCloseTo(1, 5);
});

test('BVH_FILTER lets the host turn hits down', async () => {
  const layer = (z: number) => ({
    mesh: { positions: new Float32Array([-1, -1, z, 3, -1, z, -1, 3, z]) },
    transform: identity,
  });
  const rays = new Float32Array([0, 0, 5, 0, 0, 0, -1, 1e30]);
  const layers = [layer(2), layer(1), layer(0)];
  const [all] = await trace(layers, rays);
  expect(all).toMatchObject({ instance: 0, any: true });
  const [second] = await trace(
    layers,
    rays,
    'fn bvh_accept(hit: BvhHit) -> bool { return bvh_instance(hit.instance).id == 1u; }',
  );
  expect(second).toMatchObject({ instance: 1, any: true });
  const [none] = await trace(layers, rays, 'fn bvh_accept(hit: BvhHit) -> bool { return false; }');
  expect(none).toMatchObject({ instance: 0xffffffff, any: false });
});

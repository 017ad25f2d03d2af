import { compose, wgslModule } from '@glanz/wgsl';
import { expectNoGpuErrors, runCompute, testDevice } from '@glanz/gpu';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { closestHitInstances } from '../src/index';
import { bvhOffset, bvhTraversal } from '../src/wgsl/index';
import { trace as traceIn, upload, type Layout, type Placed } from './gpu-trace';
import { affine, direction, randomNumbers, sphere, strewn } from './shapes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

const layout: Layout = { blas: (blas) => blas, tlas: (tlas) => tlas, traversal: bvhTraversal };
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

test('no ray gets between boxes that touch where triangles share an edge (seed 56)', async () => {
  // A room whose walls are grids of quads: aimed at their edges and vertices from inside, rounding moves the vertices
  // across the ray, out of the box that the ray meets and into the one beside it.
  const random = randomNumbers(56);
  for (const [size, shift] of [
    [1, [0, 0, 0]],
    [0.3, [-2.5, 9.3, 4.1]],
    [500, [3000, -700, 90]],
  ] as const) {
    const n = 6;
    const positions: number[] = [],
      indices: number[] = [];
    for (let axis = 0; axis < 3; axis++)
      for (const side of [-1, 1]) {
        const base = positions.length / 3;
        for (let i = 0; i <= n; i++)
          for (let j = 0; j <= n; j++) {
            const point = [0, 0, 0];
            point[axis] = side;
            point[(axis + 1) % 3] = (2 * i) / n - 1;
            point[(axis + 2) % 3] = (2 * j) / n - 1;
            positions.push(...point.map((x, k) => x * size + shift[k]!));
          }
        for (let i = 0; i < n; i++)
          for (let j = 0; j < n; j++) {
            const a = base + i * (n + 1) + j,
              b = a + n + 1;
            indices.push(a, b, b + 1, a, b + 1, a + 1);
          }
      }
    const mesh = { positions: new Float32Array(positions), indices: new Uint32Array(indices) };
    const count = 200_000;
    const rays = new Float32Array(8 * count);
    for (let i = 0; i < count; i++) {
      const edge = 3 * Math.floor((random() * indices.length) / 3),
        corner = i % 3,
        s = i % 2 ? 0 : random();
      // Rounded only in the ray: it then passes within rounding of the edge, on any side.
      const origin = shift.map((x) => x + 0.2 * size * (random() - 0.5));
      const [a, b] = [3 * indices[edge + corner]!, 3 * indices[edge + ((corner + 1) % 3)]!];
      rays.set(
        [
          ...origin,
          0,
          ...origin.map((x, k) => (1 - s) * mesh.positions[a + k]! + s * mesh.positions[b + k]! - x),
          3e38,
        ],
        8 * i,
      );
    }
    const hits = await trace([{ mesh, transform: identity }], rays);
    expect(hits.filter(({ any, instance }) => !any || instance === 0xffffffff)).toHaveLength(0);
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

test('a ray from the offset origin leaves its own surface behind, in sheared and far instances (seed 54)', async () => {
  const random = randomNumbers(54);
  const mesh = sphere(24);
  for (const [scale, shift] of [
    [1, 0],
    [0.001, 1],
    [5000, 2000],
  ] as const) {
    const m = affine(random, 0);
    for (let i = 0; i < 12; i++) m[i]! *= scale;
    for (let r = 0; r < 3; r++) m[12 + r] = shift * (r + 1);
    const { tlas, parts } = upload([{ mesh, transform: m }], layout);
    const points: number[] = [];
    const normals: number[] = [];
    const world = (v: number) =>
      [0, 1, 2].map(
        (r) =>
          m[r]! * mesh.positions[v]! +
          m[4 + r]! * mesh.positions[v + 1]! +
          m[8 + r]! * mesh.positions[v + 2]! +
          m[12 + r]!,
      );
    const magnitude = Math.max(
      ...[0, 1, 2].map((r) => Math.abs(m[r]!) + Math.abs(m[4 + r]!) + Math.abs(m[8 + r]!) + Math.abs(m[12 + r]!)),
    );
    for (let i = 0; i < mesh.indices.length; i += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => world(3 * mesh.indices[i + k]!)) as [number[], number[], number[]];
      const u = random() * 0.5,
        v = random() * 0.5;
      points.push(...[0, 1, 2].map((k) => Math.fround((1 - u - v) * a[k]! + u * b[k]! + v * c[k]!)), magnitude);
      const e = b.map((x, k) => x - a[k]!),
        f = c.map((x, k) => x - a[k]!);
      let n = [e[1]! * f[2]! - e[2]! * f[1]!, e[2]! * f[0]! - e[0]! * f[2]!, e[0]! * f[1]! - e[1]! * f[0]!];
      const outward = n.reduce((sum, x, k) => sum + x * (a[k]! - m[12 + k]!), 0) > 0 ? 1 : -1;
      const length = Math.hypot(...n) * outward;
      n = n.map((x) => x / length);
      normals.push(...n, 0);
    }
    const count = points.length / 4;
    const { code } = compose([
      wgslModule(
        'test/offset',
        `@group(0) @binding(0) var<storage, read> points: array<vec4f>;
@group(0) @binding(1) var<storage, read> normals: array<vec4f>;
@group(0) @binding(2) var<storage, read_write> result: array<vec4f>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x < ${count}u) { result[id.x] = vec4f(bvh_offset_origin(points[id.x].xyz, normals[id.x].xyz, points[id.x].w), 0.0); }
}`,
        [bvhOffset],
      ),
    ]);
    const origins = new Float32Array(
      await runCompute(device, code, {
        inputs: [new Float32Array(points), new Float32Array(normals)],
        outputBytes: count * 16,
        workgroups: Math.ceil(count / 64),
      }),
    );
    const rays = new Float32Array(count * 8);
    for (let i = 0; i < count; i++) {
      // Grazing: nearly within the surface of a convex body, so nothing else is there to hit.
      const n = normals.slice(4 * i, 4 * i + 3);
      const d = direction(random);
      const along = d.reduce((sum, x, k) => sum + x * n[k]!, 0);
      rays.set(
        [...origins.subarray(4 * i, 4 * i + 3), 0, ...d.map((x, k) => x - along * n[k]! + 0.01 * n[k]!), 3e38],
        8 * i,
      );
    }
    const hits = await trace([{ mesh, transform: m }], rays);
    expect(hits.filter(({ any }) => any)).toHaveLength(0);
    expect(
      closestHitInstances(tlas, parts, { origin: rays.subarray(0, 3), direction: rays.subarray(4, 7) }),
    ).toBeUndefined();
  }
});

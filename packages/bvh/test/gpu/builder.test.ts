import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterAll, afterEach, beforeAll, expect, test } from 'vitest';
import { buildBlas, closestHit, type Blas, type TriangleMesh } from '../../src/index';
import { GpuBuilder } from '../../src/gpu/index';
import { bvhStatistics, sahCost } from '../../src/statistics';
import { bruteForce, direction, randomNumbers, sphere, strewn } from '../shapes';
import { checkBlas } from '../structure';
import { buildOnGpu, deviceWith } from './builds';

let device: GPUDevice, builder: GpuBuilder;
beforeAll(async () => {
  device = await testDevice({ defaultLimits: true, features: [] });
  builder = await GpuBuilder.create(device);
});
afterEach(() => expectNoGpuErrors());
afterAll(() => builder.destroy());

/** Long triangles in all directions: their boxes are next to empty. */
function slivers(count: number, random: () => number): TriangleMesh {
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

const odd: readonly (readonly [string, TriangleMesh, kept?: number])[] = [
  ['none', { positions: new Float32Array(0) }],
  ['one', { positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]) }],
  ['one of no extent', { positions: new Float32Array(9).fill(3) }],
  [
    '10,000 identical ones',
    { positions: Float32Array.from({ length: 90_000 }, (_, i) => [0, 0, 0, 1, 0, 0, 0, 1, 0][i % 9]!) },
  ],
  ['1,000 points', { positions: new Float32Array(9000).fill(1) }],
  [
    'not finite ones among others',
    {
      positions: Float32Array.from({ length: 900 }, (_, i) =>
        i % 90 === 7 ? NaN : i % 90 === 30 ? Infinity : Math.sin(i * i),
      ),
    },
    80,
  ],
  ['not finite ones alone', { positions: new Float32Array(900).fill(NaN) }, 0],
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
  ['as small as floats go', { positions: Float32Array.from({ length: 900 }, (_, i) => 1e-37 * Math.cos(i * i)) }],
];

test('every triangle is inside all boxes above it, in leaves no larger than asked for (seed 1)', async () => {
  const random = randomNumbers(1);
  for (const count of [1, 2, 3, 4, 5, 17, 256, 257, 3000]) {
    for (const maxLeafTriangles of [1, 4, 16]) {
      const mesh = strewn(count, 0.3, random);
      const { blas, gpu } = await buildOnGpu(device, builder, mesh, { maxLeafTriangles });
      expect(blas.triangleIndices.length).toBe(count);
      expect(checkBlas(blas, mesh, maxLeafTriangles)).toBe(gpu.depth);
      expect(gpu.sahCost / sahCost(blas)).toBeCloseTo(1, 4);
      gpu.destroy();
    }
  }
});

for (const [what, mesh, kept] of odd)
  test(`builds over ${what}`, async () => {
    const { blas, gpu } = await buildOnGpu(device, builder, mesh);
    checkBlas(blas, mesh);
    const onCpu = buildBlas(mesh);
    expect([...blas.triangleIndices].sort((a, b) => a - b)).toEqual([...onCpu.triangleIndices].sort((a, b) => a - b));
    expect(blas.triangleIndices.length).toBe(kept ?? mesh.positions.length / 9);
    expect(blas.bounds).toEqual(onCpu.bounds);
    gpu.destroy();
  });

test('finds what brute force finds, among blobs and slivers (seeds 2, 3)', async () => {
  for (const [seed, make] of [
    [2, (r: () => number) => strewn(600, 0.3, r)],
    [3, (r: () => number) => slivers(600, r)],
  ] as const) {
    const random = randomNumbers(seed);
    const mesh = make(random);
    const { blas, gpu } = await buildOnGpu(device, builder, mesh);
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
    gpu.destroy();
  }
});

test('the surface area cost is at most 1.1 times that of balanced', async () => {
  for (const mesh of [sphere(128), strewn(20_000, 0.05, randomNumbers(8)), slivers(5000, randomNumbers(9))]) {
    const { blas, gpu } = await buildOnGpu(device, builder, mesh);
    checkBlas(blas, mesh);
    expect(sahCost(blas)).toBeLessThan(1.1 * sahCost(buildBlas(mesh)));
    gpu.destroy();
  }
});

test('trees are as deep as those of balanced, or a little deeper over a regular mesh', async () => {
  // Joined by surface alone, clusters that grow one by one make trees half as deep again. Splits of the regular sphere
  // halve it, so that its tree of balanced is nearly as low as trees get.
  for (const [mesh, bound] of [
    [sphere(128), 1.12],
    [strewn(20_000, 0.05, randomNumbers(8)), 1],
    [slivers(5000, randomNumbers(9)), 1],
  ] as const) {
    const { blas, gpu } = await buildOnGpu(device, builder, mesh);
    expect(bvhStatistics(blas).depth).toBeLessThanOrEqual(bound * bvhStatistics(buildBlas(mesh)).depth);
    gpu.destroy();
  }
});

test('a detail of 1/200 of the scene gets as good a tree as it gets alone (seed 10)', async () => {
  const detail = strewn(20_000, 0.05, randomNumbers(10));
  const positions = new Float32Array(detail.positions.length + 9);
  positions.set(detail.positions);
  positions.set([-200, -200, -200, 200, 200, 200, -200, 200, 200], detail.positions.length);
  const [alone, within] = [await buildOnGpu(device, builder, detail), await buildOnGpu(device, builder, { positions })];
  /** Sum of the surfaces of all boxes within the detail. */
  const surfaces = ({ nodes, nodeCount }: Blas) => {
    let sum = 0;
    for (let at = 0; at < 16 * nodeCount; at += 8) {
      const [x, y, z] = [0, 1, 2].map((k) => nodes[at + 4 + k]! - nodes[at + k]!) as [number, number, number];
      if (Math.max(x, y, z) < 10) sum += x * y + y * z + z * x;
    }
    return sum;
  };
  // Other cells make another tree, a little better or worse.
  expect(surfaces(within.blas)).toBeLessThan(1.05 * surfaces(alone.blas));
  alone.gpu.destroy();
  within.gpu.destroy();
});

test('is deterministic, also after other builds', async () => {
  const mesh = strewn(5000, 0.1, randomNumbers(7));
  const first = await buildOnGpu(device, builder, mesh);
  const other = await buildOnGpu(device, builder, sphere(40));
  const again = await buildOnGpu(device, await GpuBuilder.create(device), mesh);
  const last = await buildOnGpu(device, builder, mesh);
  expect(again.blas).toEqual(first.blas);
  expect(last.blas).toEqual(first.blas);
  for (const { gpu } of [first, other, again, last]) gpu.destroy();
});

test('indices of 16 and of 32 bits, and vertices in threes, give the same tree', async () => {
  const { positions, indices } = sphere(24);
  const flat = new Float32Array(3 * indices.length);
  for (let i = 0; i < indices.length; i++) flat.set(positions.subarray(3 * indices[i]!, 3 * indices[i]! + 3), 3 * i);
  const trees = [];
  for (const mesh of [{ positions, indices }, { positions, indices: new Uint16Array(indices) }, { positions: flat }]) {
    const { blas, gpu } = await buildOnGpu(device, builder, mesh);
    checkBlas(blas, mesh);
    trees.push(blas);
    gpu.destroy();
  }
  expect(trees[1]).toEqual(trees[0]);
  expect(trees[2]).toEqual(trees[0]);
});

test('workgroups in several rows, as large meshes need them, give the same tree', async () => {
  const mesh = strewn(5000, 0.1, randomNumbers(7));
  const { blas: expected, gpu } = await buildOnGpu(device, builder, mesh);
  gpu.destroy();
  // 20 workgroups of triangles in seven rows of three.
  const narrow = deviceWith(device, {
    limits: {
      maxStorageBufferBindingSize: device.limits.maxStorageBufferBindingSize,
      maxBufferSize: device.limits.maxBufferSize,
      maxComputeWorkgroupsPerDimension: 3,
    },
  });
  const rows = await GpuBuilder.create(narrow);
  const { blas, gpu: other } = await buildOnGpu(device, rows, mesh);
  expect(blas).toEqual(expected);
  other.destroy();
  rows.destroy();
});

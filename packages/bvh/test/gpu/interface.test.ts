import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, beforeAll, expect, test } from 'vitest';
import { packTriangles, TLAS_MAX_DEPTH } from '../../src/index';
import { GpuBuilder, gpuBuildMemory } from '../../src/gpu/index';
import { readBuffer } from '../../src/gpu/device';
import { bvhStatistics } from '../../src/statistics';
import { randomNumbers, sphere, strewn } from '../shapes';
import { checkStructure } from '../structure';
import { buildOnGpu, deviceWith, upload, uploadMesh } from './builds';

let device: GPUDevice, builder: GpuBuilder;
beforeAll(async () => {
  device = await testDevice({ defaultLimits: true, features: [] });
  builder = await GpuBuilder.create(device);
});
afterEach(() => expectNoGpuErrors());

test('packs triangles as the CPU does, bit for bit', async () => {
  for (const mesh of [sphere(16), { positions: strewn(300, 0.1, randomNumbers(1)).positions }]) {
    const { blas, gpu } = await buildOnGpu(device, builder, mesh, { packTriangles: true });
    const packed = new Float32Array(await readBuffer(device, gpu.triangles!, gpu.triangles!.size));
    expect(packed).toEqual(packTriangles(blas, mesh));
    gpu.destroy();
  }
});

test('builds over boxes, one a leaf, without those that are empty or not finite (seed 2)', async () => {
  const random = randomNumbers(2);
  for (const count of [0, 1, 2, 700, 5000]) {
    const boxes = Float32Array.from({ length: 6 * count }, (_, i) => (i % 6 < 3 ? random() : 1 + 0.1 * random()));
    const out = [3, 100, 650].filter((i) => i < count);
    out.forEach((i, k) => (boxes[6 * i + k] = [2, NaN, Infinity][k]!));
    const buffer = upload(device, boxes);
    const tree = await builder.buildBoxes({ boxes: buffer, count });
    const order = new Uint32Array(await readBuffer(device, tree.order, tree.order.size)).slice(0, tree.count);
    const nodes = new Float32Array(await readBuffer(device, tree.nodes, tree.nodes.size));
    expect([...order].sort((a, b) => a - b)).toEqual([...Array(count).keys()].filter((i) => !out.includes(i)));
    const boxOf = (i: number) => boxes.subarray(6 * order[i]!, 6 * order[i]! + 6);
    const { nodeCount } = tree;
    checkStructure({ nodes, nodeCount }, tree.count, boxOf, 1, TLAS_MAX_DEPTH);
    if (tree.count > 0) expect(bvhStatistics({ nodes, nodeCount }).sahCost / tree.sahCost).toBeCloseTo(1, 4);
    buffer.destroy();
    tree.destroy();
  }
});

test('refuses what it cannot build, with a code', async () => {
  const mesh = uploadMesh(device, sphere(8));
  const code = (what: string) => expect.objectContaining({ code: what });
  const build = (change: object, options = {}) => builder.buildBlas({ ...mesh, ...change }, options);
  await expect(build({}, { maxLeafTriangles: 17 })).rejects.toEqual(code('bvh/options'));
  await expect(build({ triangleCount: 1.5 })).rejects.toEqual(code('bvh/options'));
  await expect(build({ indexFormat: 'uint8' })).rejects.toEqual(code('bvh/options'));
  await expect(build({ vertexCount: 1000 })).rejects.toEqual(code('bvh/positions'));
  await expect(build({ triangleCount: 1000 })).rejects.toEqual(code('bvh/indices'));
  await expect(build({ indices: undefined })).rejects.toEqual(code('bvh/indices'));
  const without = device.createBuffer({ size: mesh.positions.size, usage: GPUBufferUsage.COPY_DST });
  await expect(build({ positions: without })).rejects.toEqual(code('bvh/positions'));
  without.destroy();
  // The index of the last triangle's last corner is out of range: the GPU finds that.
  const wrong = sphere(8);
  wrong.indices[wrong.indices.length - 1] = wrong.positions.length / 3;
  const bad = uploadMesh(device, wrong);
  await expect(builder.buildBlas(bad)).rejects.toThrow(`Triangle ${bad.triangleCount - 1} uses a vertex`);
  await expect(builder.buildBlas(bad)).rejects.toEqual(code('bvh/indices'));
  await expect(build({}, { timestamps: true })).rejects.toEqual(code('bvh/options'));
  await expect(build({}, { signal: AbortSignal.abort(new Error('stop')) })).rejects.toThrow('stop');
  mesh.destroy();
  bad.destroy();
});

test('refuses what the device cannot bind before it allocates, with both numbers', async () => {
  const large = 3_000_000;
  const buffers: number[] = [];
  // A device that counts allocations, and buffers that are large enough by what they say.
  const counted = deviceWith(device, { createBuffer: ({ size }: GPUBufferDescriptor) => void buffers.push(size) });
  const positions = { size: 1e9, usage: GPUBufferUsage.STORAGE } as GPUBuffer;
  const other = await GpuBuilder.create(counted);
  const built = other.buildBlas({ positions, vertexCount: 3 * large, triangleCount: large });
  await expect(built).rejects.toEqual(expect.objectContaining({ code: 'bvh/limit' }));
  await expect(built).rejects.toThrow(/binds 1000000000 bytes.*allows 134217728/);
  expect(buffers).toEqual([]);
  // As documented.
  expect(gpuBuildMemory(1_000_000) / 1e6).toBeCloseTo(225, 0);
});

test('builds that are under way when it is destroyed end with a code; what was built stays', async () => {
  const own = await GpuBuilder.create(device);
  const mesh = uploadMesh(device, sphere(16));
  const blas = await own.buildBlas(mesh);
  expect(own.memoryBytes).toBe(gpuBuildMemory(mesh.triangleCount));
  await own.releaseMemory();
  expect(own.memoryBytes).toBe(0);
  const pending = own.buildBlas(mesh);
  own.destroy();
  await expect(pending).rejects.toEqual(expect.objectContaining({ code: 'bvh/destroyed' }));
  await expect(own.buildBlas(mesh)).rejects.toEqual(expect.objectContaining({ code: 'bvh/destroyed' }));
  expect((await readBuffer(device, blas.nodes, 64)).byteLength).toBe(64);
  blas.destroy();
  mesh.destroy();
});

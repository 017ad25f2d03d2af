import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, expect, test } from 'vitest';
import { buildBlas, packTriangles } from '../../src/index';
import { best } from '../../src/builders/best';
import { GpuBuilder, GpuRefitter, readGpuBlas } from '../../src/gpu/index';
import { refitBlas } from '../../src/refit';
import { bvhStatistics } from '../../src/statistics';
import { randomNumbers, sphere, strewn } from '../shapes';
import { checkBlas } from '../structure';
import { buildOnGpu, upload, uploadMesh } from './builds';

afterEach(() => expectNoGpuErrors());

async function read(device: GPUDevice, buffer: GPUBuffer): Promise<Uint8Array> {
  const { size } = buffer;
  const staging = device.createBuffer({ size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
  const encoder = device.createCommandEncoder();
  encoder.copyBufferToBuffer(buffer, 0, staging, 0, size);
  device.queue.submit([encoder.finish()]);
  await staging.mapAsync(GPUMapMode.READ);
  const bytes = new Uint8Array(staging.getMappedRange().slice(0));
  staging.destroy();
  return bytes;
}

const moved = (positions: Float32Array, by: number): Float32Array<ArrayBuffer> =>
  new Float32Array(positions.map((x, i) => x * (1 + 0.5 * Math.sin(by * i))));

test('fits the boxes as the CPU does, bit for bit, repeatedly', async () => {
  const device = await testDevice({ defaultLimits: true, features: [] });
  const builder = await GpuBuilder.create(device);
  for (const mesh of [
    strewn(5000, 0.1, randomNumbers(1)),
    sphere(24),
    { positions: strewn(1, 1, randomNumbers(2)).positions },
  ]) {
    const { gpu, blas } = await buildOnGpu(device, builder, mesh);
    const refitter = await GpuRefitter.create(device, gpu);
    for (const by of [1, 2]) {
      const now = { ...mesh, positions: moved(mesh.positions, by) };
      const input = uploadMesh(device, now);
      await refitter.refit(input);
      const { nodes } = await readGpuBlas(device, gpu);
      refitBlas(blas, now);
      expect(nodes).toEqual(blas.nodes);
      checkBlas({ ...blas, nodes }, now);
      input.destroy();
    }
    refitter.destroy();
    gpu.destroy();
  }
  builder.destroy();
});

test('fits trees of the CPU in buffers, whatever the order of their nodes', async () => {
  const device = await testDevice({ defaultLimits: true, features: [] });
  const mesh = sphere(32);
  for (const builder of ['balanced', best] as const) {
    const blas = buildBlas(mesh, { builder });
    const nodes = upload(device, blas.nodes),
      triangleIndices = upload(device, blas.triangleIndices);
    const { nodeCount } = blas;
    const { depth } = bvhStatistics(blas);
    const refitter = await GpuRefitter.create(device, { nodes, nodeCount, triangleIndices, depth });
    const now = { ...mesh, positions: moved(mesh.positions, 3) };
    const input = uploadMesh(device, now);
    await refitter.refit(input);
    const read = await readGpuBlas(device, {
      ...blas,
      nodes,
      triangleIndices,
      triangleCount: blas.triangleIndices.length,
      depth,
      sahCost: 0,
      destroy: () => undefined,
    });
    refitBlas(blas, now);
    expect(read.nodes).toEqual(blas.nodes);
    refitter.destroy();
    await expect(refitter.refit(input)).rejects.toEqual(expect.objectContaining({ code: 'bvh/destroyed' }));
    for (const buffer of [nodes, triangleIndices, input]) buffer.destroy();
  }
});

test('a prepared refit is recorded repeatedly, and packs triangles', async () => {
  const device = await testDevice({ defaultLimits: true, features: [] });
  const builder = await GpuBuilder.create(device);
  const mesh = strewn(3000, 0.1, randomNumbers(7));
  const { gpu, blas } = await buildOnGpu(device, builder, mesh);
  const refitter = await GpuRefitter.create(device, gpu);
  const input = uploadMesh(device, mesh);
  const triangles = device.createBuffer({
    size: 48 * gpu.triangleCount,
    usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC,
  });
  const prepared = await refitter.prepare(input, triangles);
  for (const by of [1, 2, 3]) {
    const now = { ...mesh, positions: moved(mesh.positions, by) };
    device.queue.writeBuffer(input.positions, 0, now.positions);
    const encoder = device.createCommandEncoder();
    prepared.encode(encoder);
    device.queue.submit([encoder.finish()]);
    refitBlas(blas, now);
    expect((await readGpuBlas(device, gpu)).nodes).toEqual(blas.nodes);
    expect(await read(device, triangles)).toEqual(new Uint8Array(packTriangles(blas, now).buffer));
  }
  prepared.destroy();
  refitter.destroy();
  await expect(refitter.prepare(input)).rejects.toEqual(expect.objectContaining({ code: 'bvh/destroyed' }));
  for (const thing of [triangles, input, gpu, builder]) thing.destroy();
});

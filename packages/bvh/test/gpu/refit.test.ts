import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, expect, test } from 'vitest';
import { buildBlas } from '../../src/index';
import { best } from '../../src/builders/best';
import { GpuBuilder, GpuRefitter, readGpuBlas } from '../../src/gpu/index';
import { refitBlas } from '../../src/refit';
import { bvhStatistics } from '../../src/statistics';
import { randomNumbers, sphere, strewn } from '../shapes';
import { checkBlas } from '../structure';
import { buildOnGpu, upload, uploadMesh } from './builds';

afterEach(() => expectNoGpuErrors());

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

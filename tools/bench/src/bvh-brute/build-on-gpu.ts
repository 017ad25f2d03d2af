import { readGpuBlas, type GpuBuilder } from '@glanz/bvh/gpu';
import { inMemory } from '../bvh/meshes';
import type { BuildTree } from './run';

/** Builds trees on the GPU, for the CPU. Only the size of leaves is taken of the options. */
export const buildOnGpu =
  (device: GPUDevice, builder: GpuBuilder): BuildTree =>
  async (mesh, { maxLeafTriangles }) => {
    const input = inMemory(device, mesh);
    const built = await builder.buildBlas(input, { maxLeafTriangles });
    const blas = await readGpuBlas(device, built);
    built.destroy();
    input.destroy();
    return blas;
  };

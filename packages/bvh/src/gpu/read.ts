import type { Blas } from '../blas';
import { readBuffer } from './device';
import type { BoxTree } from '../instance-boxes';
import type { GpuBlas, GpuBoxTree } from './options';

/**
 * Copies a hierarchy from the GPU to the CPU, where queries, refits, `serializeBlas` and `packHierarchy` take it.
 *
 * @throws {BvhError} `bvh/device` where the device was lost.
 */
export async function readGpuBlas(device: GPUDevice, blas: GpuBlas): Promise<Blas> {
  const { nodes, nodeCount, triangleIndices, triangleCount, bounds } = blas;
  const [nodeData, indexData] = await Promise.all([
    readBuffer(device, nodes, 64 * nodeCount),
    readBuffer(device, triangleIndices, 4 * Math.max(1, triangleCount)),
  ]);
  return {
    nodes: new Float32Array(nodeData),
    nodeCount,
    triangleIndices: new Uint32Array(indexData).slice(0, triangleCount),
    bounds,
  };
}

/**
 * Copies a hierarchy over boxes from the GPU to the CPU, such as for `DynamicTlas.create`.
 *
 * @throws {BvhError} `bvh/device` where the device was lost.
 */
export async function readGpuBoxTree(
  device: GPUDevice,
  { nodes, nodeCount, order, count }: GpuBoxTree,
): Promise<BoxTree> {
  const [nodeData, orderData] = await Promise.all([
    readBuffer(device, nodes, 64 * nodeCount),
    readBuffer(device, order, 4 * Math.max(1, count)),
  ]);
  return { nodes: new Float32Array(nodeData), nodeCount, order: new Uint32Array(orderData).subarray(0, count) };
}

import { type Blas, type TriangleMesh } from '../../src/index';
import { readGpuBlas, type GpuBlas, type GpuBlasOptions, type GpuBuilder, type GpuMesh } from '../../src/gpu/index';

/** A buffer with this content; never empty, as buffers cannot be bound then. */
export function upload(device: GPUDevice, data: Float32Array | Uint32Array | Uint16Array): GPUBuffer {
  const size = Math.max(16, Math.ceil(data.byteLength / 4) * 4);
  const buffer = device.createBuffer({
    size,
    usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC,
    mappedAtCreation: true,
  });
  new Uint8Array(buffer.getMappedRange()).set(new Uint8Array(data.buffer, data.byteOffset, data.byteLength));
  buffer.unmap();
  return buffer;
}

/** A mesh in GPU buffers, with what frees them. */
export function uploadMesh(device: GPUDevice, { positions, indices }: TriangleMesh): GpuMesh & { destroy(): void } {
  const buffers = [upload(device, positions), ...(indices ? [upload(device, indices)] : [])] as const;
  return {
    positions: buffers[0],
    vertexCount: positions.length / 3,
    indices: buffers[1],
    indexFormat: indices instanceof Uint16Array ? 'uint16' : 'uint32',
    triangleCount: (indices ? indices.length : positions.length / 3) / 3,
    destroy: () => buffers.forEach((buffer) => buffer.destroy()),
  };
}

/** Builds on the GPU and reads the result back. */
export async function buildOnGpu(
  device: GPUDevice,
  builder: GpuBuilder,
  mesh: TriangleMesh,
  options: GpuBlasOptions = {},
): Promise<{ blas: Blas; gpu: GpuBlas }> {
  const input = uploadMesh(device, mesh);
  const gpu = await builder.buildBlas(input, options);
  const blas = await readGpuBlas(device, gpu);
  input.destroy();
  return { blas, gpu };
}

/** The device with some of its members replaced, as a builder sees them. */
export const deviceWith = (device: GPUDevice, members: Readonly<Record<string, unknown>>): GPUDevice =>
  new Proxy(device, {
    get: (target, name) => {
      if (typeof name === 'string' && name in members) return members[name];
      const value = Reflect.get(target, name) as unknown;
      return typeof value === 'function' ? (value as () => unknown).bind(target) : value;
    },
  });

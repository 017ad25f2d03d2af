import {
  GPU_BUFFER_COPY_DST,
  GPU_BUFFER_COPY_SRC,
  GPU_BUFFER_STORAGE,
  GPU_BUFFER_UNIFORM,
  type GpuMemory,
} from '../storage/buffers';
import records from './compact_records.wesl';
import { pipelineFor } from './pipeline-for';

/** Bytes of a record of compact shapes. */
export const RECORD_BYTES = 16;
/** Records that are made at once, 4 MiB. */
const RECORDS = 1 << 18;
/** Threads of a workgroup of compact_records.wesl. */
const GROUP = 64;

/** A hierarchy's order of a mesh's triangles, and its indices, on the GPU. */
export interface RecordSource {
  readonly order: GPUBuffer;
  readonly indices: GPUBuffer;
  readonly triangleCount: number;
  /** Place of the mesh's first vertex among the records. */
  readonly firstVertex: number;
}

/** The pipeline that {@link encodeRecords} needs. */
export const recordsPipeline = (device: GPUDevice): Promise<GPUComputePipeline> =>
  pipelineFor(device, 'glanz compact records', records);

/**
 * Records commands that write the triangles of compact shapes where the hierarchy is on the GPU.
 * `COMPACT_SHAPES.slices` writes the same on the CPU, where reading the indices of 10 million triangles in the order of
 * a hierarchy takes as long as everything else before the first sample.
 *
 * Memory: `order` and `indices` take 16 bytes a triangle from the build of a mesh until its records are made; the
 * records take up to 4 MiB more, until they are copied.
 *
 * @param copy Records a copy of so many bytes to the mesh's region, `offset` bytes from its first triangle.
 * @param atOnce Records that are made before they are copied, a multiple of 64.
 * @returns Frees what the work needs, once it is submitted.
 */
export function encodeRecords(
  { device, memory }: { readonly device: GPUDevice; readonly memory: GpuMemory },
  pipeline: GPUComputePipeline,
  encoder: GPUCommandEncoder,
  { order, indices, triangleCount, firstVertex }: RecordSource,
  copy: (from: GPUBuffer, offset: number, bytes: number) => void,
  atOnce = RECORDS,
): () => void {
  const input = memory.buffer('compact records input', 16, GPU_BUFFER_UNIFORM | GPU_BUFFER_COPY_DST);
  memory.write(input, Uint32Array.of(firstVertex, 0, 0, 0));
  const bytes = RECORD_BYTES * Math.min(atOnce, triangleCount);
  const made = memory.buffer('compact records', bytes, GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_SRC);
  for (let first = 0; first < triangleCount; first += atOnce) {
    const count = Math.min(atOnce, triangleCount - first);
    const resources = [
      { buffer: input },
      { buffer: order, offset: 4 * first, size: 4 * count },
      { buffer: indices },
      { buffer: made },
    ];
    const pass = encoder.beginComputePass({ label: 'glanz compact records' });
    pass.setPipeline(pipeline);
    pass.setBindGroup(
      0,
      device.createBindGroup({
        label: 'glanz compact records',
        layout: pipeline.getBindGroupLayout(0),
        entries: resources.map((resource, binding) => ({ binding, resource })),
      }),
    );
    pass.dispatchWorkgroups(Math.ceil(count / GROUP));
    pass.end();
    copy(made, RECORD_BYTES * first, RECORD_BYTES * count);
  }
  return () => {
    for (const buffer of [input, made]) memory.release(buffer);
  };
}

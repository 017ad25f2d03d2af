import {
  GPU_BUFFER_COPY_DST,
  GPU_BUFFER_COPY_SRC,
  GPU_BUFFER_MAP_READ,
  GPU_BUFFER_STORAGE,
  type GpuMemory,
} from '../../storage/buffers';

/** Workgroups that add up the cost: as many sums are read. */
const GROUPS = 64;
const BYTES = 4 * (GROUPS + 1);

/** Measures what a hierarchy on the GPU costs: `sahCost` of `@glanz/bvh/statistics`, in single precision. */
export class TreeCost {
  readonly #pipeline: GPUComputePipeline;
  readonly #group: GPUBindGroup;
  readonly #sums: GPUBuffer;
  readonly #staging: GPUBuffer;

  /** @param memory Frees its buffers. @param pipeline Of tree_cost.wesl. @param nodes As large as the hierarchy. */
  constructor(device: GPUDevice, memory: GpuMemory, pipeline: GPUComputePipeline, nodes: GPUBuffer) {
    this.#pipeline = pipeline;
    this.#sums = memory.buffer('pose cost', BYTES, GPU_BUFFER_STORAGE | GPU_BUFFER_COPY_SRC);
    this.#staging = memory.buffer('pose cost read', BYTES, GPU_BUFFER_MAP_READ | GPU_BUFFER_COPY_DST);
    this.#group = device.createBindGroup({
      label: 'glanz tree cost',
      layout: pipeline.getBindGroupLayout(0),
      entries: [nodes, this.#sums].map((buffer, binding) => ({ binding, resource: { buffer } })),
    });
  }

  /** Records the measurement. The one before must have been read. */
  encode(encoder: GPUCommandEncoder): void {
    const pass = encoder.beginComputePass({ label: 'glanz tree cost' });
    pass.setPipeline(this.#pipeline);
    pass.setBindGroup(0, this.#group);
    pass.dispatchWorkgroups(GROUPS);
    pass.end();
    encoder.copyBufferToBuffer(this.#sums, 0, this.#staging, 0, BYTES);
  }

  /** What was recorded last, once it is submitted. Rejects where its buffers are destroyed meanwhile. */
  async read(): Promise<number> {
    // GPUMapMode.READ, a global of browsers only.
    await this.#staging.mapAsync(1);
    const sums = new Float32Array(this.#staging.getMappedRange().slice(0, BYTES));
    this.#staging.unmap();
    const root = sums[GROUPS] as number;
    return root > 0 ? 1 + sums.subarray(0, GROUPS).reduce((a, b) => a + b, 0) / root : 1;
  }
}

/** Dispatches that one measurement can hold. */
const CAPACITY = 2048;

/** What one kernel took. */
export interface KernelTime {
  /** The innermost debug group around its dispatches, or the pipeline's label. */
  readonly kernel: string;
  /** The pipeline's label. */
  readonly pipeline: string;
  /** GPU milliseconds of all its dispatches. */
  readonly milliseconds: number;
  readonly dispatches: number;
  /** GPU milliseconds of each dispatch, in their order. */
  readonly each: readonly number[];
  /** Workgroups of its indirect dispatches. */
  readonly workgroups: number;
}

interface Name {
  readonly kernel: string;
  readonly pipeline: string;
}

/**
 * Times every dispatch of a piece of code by the GPU's own clock, from outside of that code: each gets a compute pass
 * of its own with a pair of timestamps, and the counts of indirect ones are kept. That costs gaps between dispatches,
 * so the sum is not what the code takes without the clock; shares are what it is for. Needs the feature
 * `timestamp-query`.
 */
export class KernelClock {
  readonly #device: GPUDevice;
  readonly #query: GPUQuerySet;
  readonly #times: GPUBuffer;
  readonly #counts: GPUBuffer;
  readonly #restore: () => void;
  #names: Name[] | undefined;
  #repeats = 1;
  #indirect: boolean[] = [];

  private constructor(device: GPUDevice) {
    this.#device = device;
    this.#query = device.createQuerySet({ type: 'timestamp', count: 2 * CAPACITY });
    this.#times = device.createBuffer({
      size: 16 * CAPACITY,
      usage: GPUBufferUsage.QUERY_RESOLVE | GPUBufferUsage.COPY_SRC,
    });
    this.#counts = device.createBuffer({
      size: 4 * CAPACITY,
      usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC,
    });
    const createBuffer = device.createBuffer.bind(device);
    const createCommandEncoder = device.createCommandEncoder.bind(device);
    device.createBuffer = (descriptor) =>
      createBuffer(
        descriptor.usage & GPUBufferUsage.INDIRECT
          ? { ...descriptor, usage: descriptor.usage | GPUBufferUsage.COPY_SRC }
          : descriptor,
      );
    device.createCommandEncoder = (descriptor) => this.#watch(createCommandEncoder(descriptor));
    this.#restore = () => Object.assign(device, { createBuffer, createCommandEncoder });
  }

  /**
   * From now on until {@link destroy}, the device's encoders are watched. `undefined` on devices without timestamp
   * queries. Tracers must be made after it.
   */
  static create(device: GPUDevice): KernelClock | undefined {
    return device.features.has('timestamp-query') ? new KernelClock(device) : undefined;
  }

  #watch(encoder: GPUCommandEncoder): GPUCommandEncoder {
    return new Proxy(encoder, {
      get: (target, key) => {
        if (key === 'beginComputePass' && this.#names)
          return (descriptor?: GPUComputePassDescriptor) => this.#pass(target, descriptor);
        const value = Reflect.get(target, key) as unknown;
        return typeof value === 'function' ? (value as (...args: unknown[]) => unknown).bind(target) : value;
      },
    });
  }

  #pass(encoder: GPUCommandEncoder, descriptor: GPUComputePassDescriptor | undefined): GPUComputePassEncoder {
    let pipeline: GPUComputePipeline | undefined;
    const groups: (readonly [GPUBindGroup, number[] | undefined])[] = [];
    const around: string[] = [];
    const run = (
      indirect: readonly [GPUBuffer, number] | undefined,
      dispatch: (pass: GPUComputePassEncoder) => void,
    ) => {
      const names = this.#names as Name[];
      const label = pipeline?.label ?? 'unnamed';
      const index = names.push({ kernel: around.at(-1) ?? label, pipeline: label }) - 1;
      this.#indirect[index] = indirect !== undefined;
      if (index >= CAPACITY) return;
      if (indirect) encoder.copyBufferToBuffer(indirect[0], indirect[1], this.#counts, 4 * index, 4);
      const pass = encoder.beginComputePass({
        ...descriptor,
        timestampWrites: {
          querySet: this.#query,
          beginningOfPassWriteIndex: 2 * index,
          endOfPassWriteIndex: 2 * index + 1,
        },
      });
      pass.setPipeline(pipeline as GPUComputePipeline);
      groups.forEach(([group, offsets], i) => pass.setBindGroup(i, group, offsets));
      for (let i = 0; i < this.#repeats; i++) dispatch(pass);
      pass.end();
    };
    return {
      setPipeline: (next: GPUComputePipeline) => (pipeline = next),
      setBindGroup: (index: number, group: GPUBindGroup, offsets?: number[]) => (groups[index] = [group, offsets]),
      pushDebugGroup: (name: string) => around.push(name),
      popDebugGroup: () => around.pop(),
      dispatchWorkgroups: (x: number, y?: number, z?: number) =>
        run(undefined, (pass) => pass.dispatchWorkgroups(x, y, z)),
      dispatchWorkgroupsIndirect: (buffer: GPUBuffer, offset: number) =>
        run([buffer, offset], (pass) => pass.dispatchWorkgroupsIndirect(buffer, offset)),
      end: () => undefined,
    } as unknown as GPUComputePassEncoder;
  }

  /**
   * Runs `work` and waits for the GPU.
   *
   * @param repeats How often each dispatch is run, for kernels that compute the same again: the clocks of some drivers
   *   have ticks of 65 µs. Times are those of one.
   * @throws {RangeError} when there are more dispatches than the clock can hold.
   */
  async measure(work: () => Promise<void>, repeats = 1): Promise<KernelTime[]> {
    const names: Name[] = [];
    this.#names = names;
    this.#repeats = repeats;
    try {
      await work();
    } finally {
      this.#names = undefined;
    }
    if (names.length === 0 || names.length > CAPACITY)
      throw new RangeError(`KernelClock: ${names.length} dispatches, between 1 and ${CAPACITY} can be timed`);
    const staging = this.#device.createBuffer({
      size: 20 * CAPACITY,
      usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ,
    });
    const encoder = this.#device.createCommandEncoder();
    encoder.resolveQuerySet(this.#query, 0, 2 * names.length, this.#times, 0);
    encoder.copyBufferToBuffer(this.#times, 0, staging, 0, 16 * CAPACITY);
    encoder.copyBufferToBuffer(this.#counts, 0, staging, 16 * CAPACITY, 4 * CAPACITY);
    this.#device.queue.submit([encoder.finish()]);
    await staging.mapAsync(GPUMapMode.READ);
    const data = staging.getMappedRange().slice(0);
    staging.destroy();
    return this.#sum(names, repeats, new BigUint64Array(data, 0, 2 * CAPACITY), new Uint32Array(data, 16 * CAPACITY));
  }

  #sum(names: readonly Name[], repeats: number, times: BigUint64Array, counts: Uint32Array): KernelTime[] {
    const sums = new Map<string, { -readonly [K in keyof KernelTime]: KernelTime[K] } & { each: number[] }>();
    names.forEach((name, i) => {
      const key = `${name.kernel}\n${name.pipeline}`;
      const sum = sums.get(key) ?? { ...name, milliseconds: 0, dispatches: 0, workgroups: 0, each: [] };
      const milliseconds = Number((times[2 * i + 1] as bigint) - (times[2 * i] as bigint)) / 1e6 / repeats;
      sum.each.push(milliseconds);
      sum.milliseconds += milliseconds;
      sum.dispatches++;
      if (this.#indirect[i]) sum.workgroups += counts[i] as number;
      sums.set(key, sum);
    });
    return [...sums.values()];
  }

  destroy(): void {
    this.#restore();
    this.#query.destroy();
    this.#times.destroy();
    this.#counts.destroy();
  }
}

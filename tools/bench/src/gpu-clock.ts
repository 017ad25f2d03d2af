/** Submissions that one measurement can hold. */
const CAPACITY = 2048;

interface Submitter {
  submit(this: GPUQueue, buffers: Iterable<GPUCommandBuffer>): undefined;
}

/**
 * Times what a piece of code submits by the GPU's own clock, from outside of that code: around every submission it puts
 * a pair of timestamps. Needs the feature `timestamp-query`.
 */
export class GpuClock {
  readonly #device: GPUDevice;
  readonly #query: GPUQuerySet;
  readonly #resolved: GPUBuffer;
  readonly #staging: GPUBuffer;

  private constructor(device: GPUDevice) {
    this.#device = device;
    this.#query = device.createQuerySet({ type: 'timestamp', count: 2 * CAPACITY });
    this.#resolved = device.createBuffer({
      size: 16 * CAPACITY,
      usage: GPUBufferUsage.QUERY_RESOLVE | GPUBufferUsage.COPY_SRC,
    });
    this.#staging = device.createBuffer({
      size: 16 * CAPACITY,
      usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ,
    });
  }

  /** `undefined` on devices without timestamp queries. */
  static create(device: GPUDevice): GpuClock | undefined {
    return device.features.has('timestamp-query') ? new GpuClock(device) : undefined;
  }

  #stamp(index: number): GPUCommandBuffer {
    const encoder = this.#device.createCommandEncoder();
    encoder.beginComputePass({ timestampWrites: { querySet: this.#query, beginningOfPassWriteIndex: index } }).end();
    return encoder.finish();
  }

  /**
   * Runs `work` and waits for the GPU.
   *
   * @returns `busy`: milliseconds summed over the submissions, without the gaps between them; `span`: from the begin of
   * the first to the end of the last; `submissions`: how many there were.
   * @throws {RangeError} when there are more submissions than the clock can hold.
   */
  async measure(
    work: () => Promise<void>,
  ): Promise<{ readonly busy: number; readonly span: number; readonly submissions: number }> {
    const queue = this.#device.queue;
    // On the prototype: the binding may return a new queue object at each look.
    const prototype = Object.getPrototypeOf(queue) as Submitter;
    const original = prototype.submit;
    const stamp = (index: number) => this.#stamp(index);
    let submissions = 0;
    prototype.submit = function submit(buffers) {
      const index = submissions++;
      return original.call(this, index < CAPACITY ? [stamp(2 * index), ...buffers, stamp(2 * index + 1)] : buffers);
    };
    try {
      await work();
    } finally {
      prototype.submit = original;
    }
    if (submissions === 0 || submissions > CAPACITY)
      throw new RangeError(`GpuClock: ${submissions} submissions, between 1 and ${CAPACITY} can be timed`);
    const encoder = this.#device.createCommandEncoder();
    encoder.resolveQuerySet(this.#query, 0, 2 * submissions, this.#resolved, 0);
    encoder.copyBufferToBuffer(this.#resolved, 0, this.#staging, 0, 16 * submissions);
    queue.submit([encoder.finish()]);
    await this.#staging.mapAsync(GPUMapMode.READ, 0, 16 * submissions);
    const times = new BigUint64Array(this.#staging.getMappedRange(0, 16 * submissions).slice(0));
    this.#staging.unmap();
    const milliseconds = (from: number, to: number) => Number((times[to] as bigint) - (times[from] as bigint)) / 1e6;
    let busy = 0;
    for (let i = 0; i < submissions; i++) busy += milliseconds(2 * i, 2 * i + 1);
    return { busy, span: milliseconds(0, 2 * submissions - 1), submissions };
  }

  destroy(): void {
    this.#query.destroy();
    this.#resolved.destroy();
    this.#staging.destroy();
  }
}

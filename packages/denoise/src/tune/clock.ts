import { COPY_DST, COPY_SRC, MAP_READ, QUERY_RESOLVE } from '../gpu';

/** Records dispatches. */
export type Work = (pass: GPUComputePassEncoder) => void;

/** Pieces of work that are timed at once. */
export const CLOCK_CAPACITY = 8;

/** Times work: by the GPU's own clock where the device has the feature `timestamp-query`, else by the wall's. */
export class TuneClock {
  readonly #device: GPUDevice;
  readonly #lost: Promise<never>;
  readonly #query: GPUQuerySet | undefined;
  readonly #buffers: GPUBuffer[] = [];

  /** @param lost Rejects when the device is lost. */
  constructor(device: GPUDevice, lost: Promise<never>) {
    this.#device = device;
    this.#lost = lost;
    if (!device.features.has('timestamp-query')) return;
    this.#query = device.createQuerySet({ label: 'denoise tune', type: 'timestamp', count: 2 * CLOCK_CAPACITY });
    for (const usage of [QUERY_RESOLVE | COPY_SRC, COPY_DST | MAP_READ])
      this.#buffers.push(device.createBuffer({ label: 'denoise tune', size: 16 * CLOCK_CAPACITY, usage }));
  }

  /** Milliseconds of each, computed one after the other. */
  async measure(works: readonly Work[]): Promise<number[]> {
    if (this.#query) return this.#byTimestamps(this.#query, works);
    const times: number[] = [];
    for (const work of works) {
      const encoder = this.#device.createCommandEncoder({ label: 'denoise tune' });
      const pass = encoder.beginComputePass({ label: 'denoise tune' });
      work(pass);
      pass.end();
      const start = performance.now();
      this.#device.queue.submit([encoder.finish()]);
      await Promise.race([this.#device.queue.onSubmittedWorkDone(), this.#lost]);
      times.push(performance.now() - start);
    }
    return times;
  }

  async #byTimestamps(querySet: GPUQuerySet, works: readonly Work[]): Promise<number[]> {
    const [resolved, staging] = this.#buffers as [GPUBuffer, GPUBuffer];
    const encoder = this.#device.createCommandEncoder({ label: 'denoise tune' });
    for (const [i, work] of works.entries()) {
      const timestampWrites = { querySet, beginningOfPassWriteIndex: 2 * i, endOfPassWriteIndex: 2 * i + 1 };
      const pass = encoder.beginComputePass({ label: 'denoise tune', timestampWrites });
      work(pass);
      pass.end();
    }
    encoder.resolveQuerySet(querySet, 0, 2 * works.length, resolved, 0);
    encoder.copyBufferToBuffer(resolved, 0, staging, 0, 16 * works.length);
    this.#device.queue.submit([encoder.finish()]);
    await Promise.race([staging.mapAsync(MAP_READ), this.#lost]);
    const stamps = new BigUint64Array(staging.getMappedRange().slice(0));
    staging.unmap();
    return works.map((_, i) => Number(stamps[2 * i + 1]! - stamps[2 * i]!) / 1e6);
  }

  destroy(): void {
    this.#query?.destroy();
    for (const buffer of this.#buffers) buffer.destroy();
  }
}

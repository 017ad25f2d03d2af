import { TEMPORAL_AOVS, TemporalFilter, type FrameStep } from '@glanz/denoise/temporal';
import type { PathTracer } from '@glanz/renderer';
import type { GpuImage } from './display';

/** Films of more pixels are shown as they are: the filter takes 224 bytes a pixel, and the AOVs 72. */
const MAX_PIXELS = 2 ** 22;

/** Filters the frames of one tracer's preview over time. */
export class FrameReuse {
  readonly #filter: TemporalFilter;
  readonly #tracer: PathTracer;
  /** A film of so many pixels has found no memory. */
  #limit = MAX_PIXELS;

  private constructor(filter: TemporalFilter, tracer: PathTracer) {
    this.#filter = filter;
    this.#tracer = tracer;
  }

  /**
   * Compiles the filter, and has the tracer record what it needs.
   *
   * @throws {DenoiseError} {DeviceError}
   */
  static async create(device: GPUDevice, tracer: PathTracer): Promise<FrameReuse> {
    const filter = await TemporalFilter.create(device);
    try {
      await tracer.setAovs([...new Set([...tracer.aovs, ...TEMPORAL_AOVS])]);
    } catch (error) {
      filter.destroy();
      throw error;
    }
    return new FrameReuse(filter, tracer);
  }

  /**
   * The film as it is now, filtered; valid until the next call. `undefined` where there is no memory for it.
   *
   * @throws {DenoiseError} {RenderError} {DeviceError} of a device that is lost, or a tracer that is destroyed.
   */
  async image(step: FrameStep, instancesMoved: boolean): Promise<GpuImage | undefined> {
    const { width, height } = this.#tracer;
    if (width * height > this.#limit) return undefined;
    try {
      await this.#filter.prepare(width, height);
    } catch (error) {
      if ((error as { readonly code?: unknown }).code !== 'denoise/memory') throw error;
      this.#limit = width * height - 1;
      return undefined;
    }
    // An edit or another size may have come meanwhile.
    if (this.#tracer.samples === 0 || this.#tracer.width !== width || this.#tracer.height !== height) return undefined;
    return { buffer: this.#filter.filterTracer(this.#tracer, step, instancesMoved).buffer, size: [width, height] };
  }

  /** Frees the memory until the next frame, which begins without a history. */
  release(): void {
    this.#filter.release();
  }

  destroy(): void {
    this.#filter.destroy();
  }
}

import { isSoftware, type PathTracer } from '@glanz/renderer';
import type { GpuImage } from './display';
import type { FrameReuse } from './frame-reuse';
import type { PreviewMode } from './preview';

/**
 * What moving frames have of those before them: nothing until the filter is loaded and compiled, for which the first
 * movement does not wait. Frees the filter with its tracer.
 */
export class PreviewReuse {
  readonly #mode: () => PreviewMode;
  readonly #device: () => GPUDevice | undefined;
  #tracer: PathTracer | undefined;
  #filter: FrameReuse | undefined;
  #image: GpuImage | undefined;
  /** Number of the first sample of the film, which differs from frame to frame. */
  #first = 0;

  /** @param device Of the tracer at present. */
  constructor(mode: () => PreviewMode, device: () => GPUDevice | undefined) {
    this.#mode = mode;
    this.#device = device;
  }

  /** The last frame, filtered, while the film shows the same. */
  get image(): GpuImage | undefined {
    return this.#image;
  }

  /** Whether the film's samples are not those of the image at rest. */
  get shifted(): boolean {
    return this.#first > 0;
  }

  /**
   * A frame is about to change. Frames of the same random numbers would have the same noise, which would never average
   * out.
   */
  shift(tracer: PathTracer): void {
    this.#follow(tracer);
    if (!this.#filter) return;
    this.#first = (this.#first + tracer.samples) % 2 ** 30 || 1;
    tracer.reset({ firstSample: this.#first });
  }

  /** The movement is over: the film begins with its own samples. */
  rest(tracer: PathTracer): void {
    this.#first = 0;
    tracer.reset({ firstSample: 0 });
  }

  /**
   * Filters what the film shows.
   *
   * @param changed Whether it shows something else than before.
   * @param still Whether the camera has not moved since.
   * @param edited Whether the scene was edited since.
   */
  async filter(tracer: PathTracer, changed: boolean, still: boolean, edited: boolean): Promise<void> {
    const filter = this.#follow(tracer) ? this.#filter : undefined;
    // Without a history the tracer tells no motion: there is none where the camera stands still.
    const step = !changed ? 'continues' : tracer.history || still ? 'moves' : 'cuts';
    const image = await filter?.image(step, edited).catch(() => undefined);
    if (filter === this.#filter) this.#image = image;
  }

  /** The film shows something else. */
  forget(): void {
    this.#image = undefined;
  }

  /** Frees memory: nothing moves for a while. */
  release(): void {
    this.forget();
    this.#filter?.release();
  }

  /** Another tracer comes, or none. */
  drop(): void {
    this.#free();
    this.#first = 0;
  }

  #free(): void {
    this.forget();
    this.#filter?.destroy();
    this.#tracer = this.#filter = undefined;
  }

  /** Loads the filter of a tracer. */
  #follow(tracer: PathTracer): boolean {
    const mode = this.#mode();
    const device = this.#device();
    if (!device || mode === 'raw' || (mode === 'auto' && isSoftware(device.adapterInfo))) {
      this.#free();
      return false;
    }
    if (tracer === this.#tracer) return true;
    this.#free();
    this.#tracer = tracer;
    import('./frame-reuse')
      .then(({ FrameReuse: made }) => made.create(device, tracer))
      .then(
        (filter) => {
          if (tracer === this.#tracer) this.#filter = filter;
          else filter.destroy();
        },
        // Frames are shown with their noise.
        () => undefined,
      );
    return true;
  }
}

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
  /** Number of the first sample of the film, which differs from frame to frame, and samples of the frame before. */
  #first = 0;
  #taken = 0;
  /** The tracer whose first frame was shown: the filter is loaded for those that follow. */
  #shown: PathTracer | undefined;

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
   * A frame of another film is about to be rendered. Frames of the same random numbers would have the same noise, which
   * would never average out.
   */
  shift(tracer: PathTracer): void {
    if (tracer === this.#shown) this.#follow(tracer);
    this.#shown = tracer;
    if (!this.#filter) return;
    this.#first = (this.#first + this.#taken) % 2 ** 30 || 1;
    this.#taken = 0;
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
   * @param begun Whether the film has begun again since the frame before.
   * @param still Whether the camera has not moved since.
   * @param edited Whether the scene was edited since.
   */
  async filter(tracer: PathTracer, begun: boolean, still: boolean, edited: boolean): Promise<void> {
    const filter = this.#filter;
    this.#taken = tracer.samples;
    // Without a history the tracer tells no motion: there is none where the camera does not move.
    const step = !begun ? 'continues' : tracer.history || still ? 'moves' : 'cuts';
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
    this.#first = this.#taken = 0;
    this.#shown = undefined;
  }

  #free(): void {
    this.forget();
    this.#filter?.destroy();
    this.#tracer = this.#filter = undefined;
  }

  /** Loads the filter of a tracer, where the mode asks for one. */
  #follow(tracer: PathTracer): void {
    const mode = this.#mode();
    const device = this.#device();
    if (!device || mode === 'raw' || (mode === 'auto' && isSoftware(device.adapterInfo))) return this.#free();
    if (tracer === this.#tracer) return;
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
  }
}

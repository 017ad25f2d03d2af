import type { RealtimeIntegrator } from '@glanz/denoise/temporal';
import { isSoftware, type PathTracer, type RenderOptions, type RenderProgress } from '@glanz/renderer';
import type { GpuImage } from './display';
import type { PreviewMode } from './preview';

type Realtime = RealtimeIntegrator<RenderOptions, RenderProgress>;

/**
 * Chooses what renders moving frames: the tracer, which is progressive, until a realtime integrator over it is loaded and
 * compiled, for which the first movement does not wait. Frees that with its tracer.
 */
export class PreviewReuse {
  readonly #mode: () => PreviewMode;
  readonly #device: () => GPUDevice | undefined;
  #tracer: PathTracer | undefined;
  #realtime: Realtime | undefined;
  #image: GpuImage | undefined;
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
    return !!this.#realtime?.shifted;
  }

  /** A frame of another film is about to be rendered. */
  begin(tracer: PathTracer): void {
    if (tracer === this.#shown) this.#follow(tracer);
    this.#shown = tracer;
  }

  /**
   * Adds a frame's samples to the film, and filters it where that is possible.
   *
   * @param edited Whether the scene was edited since the frame before.
   */
  async *render(tracer: PathTracer, options: RenderOptions, edited: boolean): AsyncGenerator<RenderProgress> {
    const realtime = this.#realtime;
    try {
      yield* realtime ? realtime.render({ ...options, instancesMoved: edited }) : tracer.render(options);
    } catch (error) {
      // The film has its samples; what filters them fails where AOVs were taken away, or the device is lost.
      if (!(error as { readonly code?: string }).code?.startsWith('denoise')) throw error;
    }
    if (realtime === this.#realtime)
      this.#image = realtime?.filtered
        ? { buffer: realtime.beautyBuffer, size: [realtime.width, realtime.height] }
        : undefined;
  }

  /** The movement is over: the film begins with its own samples. */
  rest(): void {
    this.#realtime?.rest();
  }

  /** The film shows something else. */
  forget(): void {
    this.#image = undefined;
  }

  /** Frees memory: nothing moves for a while. */
  release(): void {
    this.forget();
    this.#realtime?.release();
  }

  /** Another tracer comes, or none. */
  drop(): void {
    this.#free();
    this.#shown = undefined;
  }

  #free(): void {
    this.forget();
    this.#realtime?.destroy();
    this.#tracer = this.#realtime = undefined;
  }

  /** Loads the realtime integrator of a tracer, where the mode asks for one. */
  #follow(tracer: PathTracer): void {
    const mode = this.#mode();
    const device = this.#device();
    if (!device || mode === 'raw' || (mode === 'auto' && isSoftware(device.adapterInfo))) {
      this.rest();
      return this.#free();
    }
    if (tracer === this.#tracer) return;
    this.#free();
    this.#tracer = tracer;
    import('./realtime')
      .then(({ RealtimeIntegrator: made }) => made.create(device, tracer))
      .then(
        (realtime) => {
          if (tracer === this.#tracer) this.#realtime = realtime;
          else realtime.destroy();
        },
        // Frames are shown with their noise.
        () => undefined,
      );
  }
}

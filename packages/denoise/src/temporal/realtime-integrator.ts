import type { DenoiseError } from '../error';
import { TEMPORAL_AOVS, type FilterableCamera, type FilterableTracer, type TemporalFilterOptions } from './options';
import { TemporalFilter } from './temporal-filter';

/** Films of more pixels are shown as they are: the filter takes 224 bytes a pixel, and the AOVs 72. */
const MAX_PIXELS = 2 ** 22;
/** First samples of films are numbered below it. */
const SAMPLE_NUMBERS = 2 ** 30;

/**
 * Renders a scene and has its image in a GPU buffer: a `PathTracer` of `@glanz/renderer`, which is progressive, or a
 * {@link RealtimeIntegrator} over it. Edits are made at the tracer, whichever of the two is shown.
 */
export interface FrameIntegrator<Options extends object = object, Progress = unknown> {
  /** Pixels. */
  readonly width: number;
  /** Pixels. */
  readonly height: number;
  /** Samples per pixel of the film, 0 after an edit. */
  readonly samples: number;
  /** Linear radiance and alpha, four floats a pixel, the top row first. */
  readonly beautyBuffer: GPUBuffer;
  /** Adds samples to the film, and yields after each submission. */
  render(options?: Options): AsyncIterable<Progress>;
  /** Copies the image to the CPU: linear RGBA, stride 4, top row first. */
  read(layer: 'beauty'): Promise<Float32Array<ArrayBuffer>>;
}

/** The part of a `PathTracer` of `@glanz/renderer` that a {@link RealtimeIntegrator} needs. */
export interface RealtimeTracer<Options extends object = object, Progress = unknown>
  extends FilterableTracer, FrameIntegrator<Options, Progress> {
  readonly samples: number;
  reset(options: { readonly firstSample: number; readonly lightReuse?: boolean }): void;
  setAovs(names: readonly string[]): Promise<unknown>;
  setLightReuse(on: boolean): Promise<unknown>;
}

/** Options of {@link RealtimeIntegrator.create}, besides those of the filter. */
export interface RealtimeIntegratorOptions {
  /**
   * Whether frames reuse light samples of the frame before (ReSTIR DI). It takes noise from each frame where many lights
   * compete, but little from the filtered image, since frames then have similar noise, and a frame takes longer: measure
   * it. Default false.
   */
  readonly lightReuse?: boolean;
}

/** Options of {@link RealtimeIntegrator.render}, besides those of the tracer. */
export interface RealtimeOptions {
  /**
   * Whether instances have moved since the last frame. Default: whether the scene was edited and the camera has not
   * moved.
   */
  readonly instancesMoved?: boolean;
}

const sameCamera = (a: FilterableCamera | undefined, b: FilterableCamera) =>
  a?.type === b.type && a.yfov === b.yfov && Array.from(a.transform).every((value, i) => value === b.transform[i]);

/**
 * Frames of a scene that moves, with as few samples as there is time for: each edit begins a film with other random
 * numbers than the one before, and the image is that film filtered with the frames before it ({@link TemporalFilter}).
 * It is biased. The film of the same tracer is the progressive one, which is never filtered: after {@link rest} it has
 * the samples of a film that never moved, bit for bit.
 *
 * @example
 * const realtime = await RealtimeIntegrator.create(device, tracer);
 * // a frame
 * await tracer.setCamera(camera);
 * for await (const progress of realtime.render({ samples: 1 })) void progress;
 * show(realtime.beautyBuffer);
 * // at rest
 * realtime.rest();
 * for await (const progress of tracer.render({ samples: 256 })) show(tracer.beautyBuffer);
 */
export class RealtimeIntegrator<Options extends object = object, Progress = unknown> implements FrameIntegrator<
  Options,
  Progress
> {
  readonly #filter: TemporalFilter;
  readonly #tracer: RealtimeTracer<Options, Progress>;
  readonly #lightReuse: boolean;
  #image: GPUBuffer | undefined;
  #camera: FilterableCamera | undefined;
  /** Number of the first sample of the film, and samples that it had at the last frame. */
  #first = 0;
  #taken = 0;
  /** A film of so many pixels has found no memory. */
  #limit = MAX_PIXELS;
  #destroyed = false;

  private constructor(filter: TemporalFilter, tracer: RealtimeTracer<Options, Progress>, lightReuse: boolean) {
    this.#filter = filter;
    this.#tracer = tracer;
    this.#lightReuse = lightReuse;
  }

  /**
   * Compiles the filter, and has the tracer record the AOVs that it needs.
   *
   * @param device The tracer's.
   * @param tracer It stays the caller's to destroy.
   * @throws {DenoiseError} `denoise/option`, `denoise/pipeline`. What `setAovs` of the tracer throws.
   */
  static async create<Options extends object, Progress>(
    device: GPUDevice,
    tracer: RealtimeTracer<Options, Progress>,
    { lightReuse = false, ...options }: TemporalFilterOptions & RealtimeIntegratorOptions = {},
  ): Promise<RealtimeIntegrator<Options, Progress>> {
    const filter = await TemporalFilter.create(device, options);
    try {
      if (lightReuse) await tracer.setLightReuse(true);
      await tracer.setAovs([...new Set([...tracer.aovs, ...TEMPORAL_AOVS])]);
      options.signal?.throwIfAborted();
    } catch (error) {
      filter.destroy();
      throw error;
    }
    return new RealtimeIntegrator(filter, tracer, lightReuse);
  }

  /** Pixels. */
  get width(): number {
    return this.#tracer.width;
  }

  /** Pixels. */
  get height(): number {
    return this.#tracer.height;
  }

  /** Samples per pixel of the film. */
  get samples(): number {
    return this.#tracer.samples;
  }

  /** Whether {@link beautyBuffer} is filtered: not before the first frame, nor where the GPU has no memory for it. */
  get filtered(): boolean {
    return this.#image !== undefined;
  }

  /**
   * The last frame: linear radiance and alpha, four floats a pixel, the top row first. Filtered, it is valid until the
   * next frame; else it is that of the tracer.
   */
  get beautyBuffer(): GPUBuffer {
    return this.#image ?? this.#tracer.beautyBuffer;
  }

  /** Whether the film's samples are not those of the image at rest. */
  get shifted(): boolean {
    return this.#first > 0;
  }

  /** Bytes on the GPU: what the last size needs. */
  get memoryBytes(): number {
    return this.#filter.memoryBytes;
  }

  /**
   * Adds samples to the tracer's film, then filters it. A film that was begun since the last frame is the next frame of
   * the movement. A film of more than four million pixels, or one that the GPU has no memory to filter, is left as it is.
   *
   * @param options Those of the tracer's `render`, and {@link RealtimeOptions}.
   * @throws What the tracer throws; {@link DenoiseError} as `TemporalFilter.filterTracer` does.
   */
  async *render(options: Options & RealtimeOptions = {} as Options): AsyncGenerator<Progress, void, undefined> {
    const { instancesMoved, ...own } = options;
    const tracer = this.#tracer;
    const begun = tracer.samples === 0;
    if (begun) this.#begin();
    try {
      yield* tracer.render(own as unknown as Options);
    } finally {
      this.#taken = tracer.samples;
    }
    this.#image = undefined;
    this.#image = await this.#filtered(begun, instancesMoved);
  }

  /**
   * Copies the last frame to the CPU: linear RGBA, stride 4, top row first.
   *
   * @throws {DenoiseError} `denoise/destroyed`. What the tracer throws.
   */
  async read(layer: 'beauty'): Promise<Float32Array<ArrayBuffer>> {
    const { width, height } = this;
    return this.#image ? this.#filter.read({ buffer: this.#image, width, height }) : this.#tracer.read(layer);
  }

  /** Nothing moves any more: the film begins with the samples of the image at rest, if it has others. */
  rest(): void {
    this.#image = undefined;
    if (this.shifted) this.#tracer.reset({ firstSample: 0 });
    this.#first = this.#taken = 0;
  }

  /** Frees the memory for images; the next frame makes it again, and has no history. */
  release(): void {
    this.#image = undefined;
    this.#filter.release();
  }

  /** Frees everything on the GPU. The tracer stays. */
  destroy(): void {
    this.#destroyed = true;
    this.#image = undefined;
    this.#filter.destroy();
  }

  /** Frames of the same random numbers would have the same noise, which would never average out. */
  #begin(): void {
    this.#first = (this.#first + this.#taken) % SAMPLE_NUMBERS || 1;
    this.#taken = 0;
    this.#tracer.reset({ firstSample: this.#first, lightReuse: this.#lightReuse });
  }

  async #filtered(begun: boolean, instancesMoved: boolean | undefined): Promise<GPUBuffer | undefined> {
    const tracer = this.#tracer;
    const { width, height, samples } = tracer;
    if (samples === 0 || width * height > this.#limit || this.#destroyed) return undefined;
    try {
      await this.#filter.prepare(width, height);
    } catch (error) {
      if (this.#destroyed) return undefined;
      if ((error as DenoiseError).code !== 'denoise/memory') throw error;
      this.#limit = width * height - 1;
      return undefined;
    }
    // An edit or another size may have come meanwhile.
    if (this.#destroyed || tracer.samples === 0 || tracer.width !== width || tracer.height !== height) return undefined;
    const still = sameCamera(this.#camera, tracer.camera);
    this.#camera = tracer.camera;
    // Without a history the tracer tells no motion: there is none where the camera does not move.
    const step = !begun ? 'continues' : tracer.history || still ? 'moves' : 'cuts';
    return this.#filter.filterTracer(tracer, step, instancesMoved ?? still).buffer;
  }
}

import type { AovName, PathTracer } from '@glanz/renderer';
import { untilAborted, type GlanzError } from '@glanz/scene';
import type { Denoising, DenoiseSession } from './denoise-session';
import type { GpuImage } from './display';
import { ViewerError } from './errors';
import { markPng } from './png-text';
import { soon } from './visibility';

export type { Denoising } from './denoise-session';

/** A denoised film on the GPU. */
export interface DenoisedImage {
  /** Linear RGBA, four floats a pixel, with the usage `STORAGE`; valid until another image of another size is denoised. */
  readonly buffer: GPUBuffer;
  readonly width: number;
  readonly height: number;
}

/** What denoises films on one device: `FilmDenoiser` of `@glanz/denoise/film`, or anything of its shape. */
export interface ImageDenoiser {
  /**
   * Denoises what a tracer has rendered so far; one at a time, later calls wait. The film is only read.
   *
   * @param tracer It records the AOVs `albedo` and `normal`.
   * @throws the signal's reason, when aborted.
   */
  denoiseTracer(tracer: PathTracer, options: { readonly signal: AbortSignal }): Promise<DenoisedImage>;
  /** Copies a result to the CPU: linear RGBA, stride 4, top row first. */
  read(image: DenoisedImage): Promise<Float32Array>;
  /** Frees everything on the GPU; work that is under way rejects. */
  destroy(): void;
}

/** Options for {@link denoising}. */
export interface DenoisingOptions {
  /** Name of the denoiser in the metadata of PNG files. Default `Open Image Denoise`. */
  readonly name?: string;
}

const GUIDES = ['albedo', 'normal'] as const satisfies readonly AovName[];
/** While samples are added, rendering takes so many times as long as denoising at least. */
const RENDERING = 3;
/** Codes of errors that a lost device or the end of a viewer causes. */
const PASSING: ReadonlySet<unknown> = new Set(['denoise/device', 'denoise/destroyed', 'renderer/device-lost']);

/**
 * Denoises the images of a viewer while they have few samples: the first one, then each time that the samples have
 * doubled, and the finished one. After the first image, denoising takes at most a quarter of the time. The film is not
 * changed.
 *
 * @param create Makes the denoiser of a device; called again after a loss. Where it or the denoiser rejects, the images
 * are shown with their noise, and the `warning` event says why, once (`viewer/denoise`; `error.cause` is the reason).
 * @example
 * const weights = fetch(smallUrl()).then((response) => response.arrayBuffer());
 * const denoise = denoising(async (device) =>
 *   FilmDenoiser.create(device, { color: await weights }),
 * );
 * const viewer = createViewer(canvas, { denoise });
 */
export function denoising(
  create: (device: GPUDevice) => Promise<ImageDenoiser> | ImageDenoiser,
  { name = 'Open Image Denoise' }: DenoisingOptions = {},
): Denoising {
  const source: Denoising = (warn, device) => new Session(source, async (on) => create(on), name, warn, device);
  return source;
}

class Session implements DenoiseSession {
  readonly source: Denoising;
  readonly #create: (device: GPUDevice) => Promise<ImageDenoiser>;
  readonly #name: string;
  readonly #warn: (error: GlanzError) => void;
  /** The device of the viewer, and that of the denoiser. */
  readonly #now: () => GPUDevice | undefined;
  #device: GPUDevice | undefined;
  #coming: Promise<ImageDenoiser> | undefined;
  #denoiser: ImageDenoiser | undefined;
  /** The tracer on the screen. */
  #tracer: PathTracer | undefined;
  #shown: { readonly tracer: PathTracer; readonly samples: number; readonly image: GpuImage } | undefined;
  /** Counts images: a result that came late is not shown. */
  #turn = 0;
  /** When the last image was denoised, and the milliseconds that it took. */
  #ended = 0;
  #cost = 0;
  /** Images of so many pixels are not denoised: there is no memory for them, or 0: something failed. */
  #limit = Infinity;
  #warned = false;

  constructor(
    source: Denoising,
    create: (device: GPUDevice) => Promise<ImageDenoiser>,
    name: string,
    warn: (error: GlanzError) => void,
    now: () => GPUDevice | undefined,
  ) {
    this.source = source;
    this.#create = create;
    this.#name = name;
    this.#warn = warn;
    this.#now = now;
  }

  aovs(requested: readonly AovName[] = []): readonly AovName[] {
    return [...new Set([...requested, ...GUIDES])];
  }

  async offer(tracer: PathTracer, signal: AbortSignal, last = false): Promise<boolean> {
    const device = this.#now();
    const pixels = tracer.width * tracer.height;
    const { samples } = tracer;
    if (!device || signal.aborted || samples === 0 || pixels >= this.#limit) return false;
    this.#tracer = tracer;
    const coming = this.#on(device);
    // The weights may come late, and an image that is done waits for them; one that is not goes on.
    if (!(last ? samples !== this.#shown?.samples : this.#denoiser && this.#due(samples))) return false;
    const turn = this.#turn;
    try {
      const denoiser = await untilAborted(coming, signal);
      const started = performance.now();
      const { buffer, width, height } = await this.#run(denoiser, tracer, signal);
      this.#ended = performance.now();
      this.#cost = this.#ended - started;
      if (turn !== this.#turn) return false;
      this.#shown = { tracer, samples, image: { buffer, size: [width, height] } };
      return true;
    } catch (error) {
      if (!signal.aborted) await this.#failed(error, device, pixels);
      return false;
    }
  }

  image(tracer: PathTracer): GpuImage | undefined {
    const { tracer: denoised, samples, image } = this.#shown ?? {};
    const [width, height] = image?.size ?? [];
    return denoised === tracer && tracer.samples >= samples! && tracer.width === width && tracer.height === height
      ? image
      : undefined;
  }

  forget(): void {
    this.#turn++;
    this.#shown = undefined;
  }

  async still(tracer: PathTracer, signal: AbortSignal): Promise<Float32Array | undefined> {
    const device = this.#now();
    const pixels = tracer.width * tracer.height;
    if (!device || pixels >= this.#limit) return undefined;
    // The denoiser of the screen serves the screen's size; its image is shown until the next one.
    const shared = tracer === (this.#tracer ??= tracer);
    let own: ImageDenoiser | undefined;
    try {
      const screen = await this.#on(device);
      const denoiser = shared ? screen : (own = await this.#create(device));
      signal.throwIfAborted();
      return await denoiser.read(await this.#run(denoiser, tracer, signal));
    } catch (error) {
      signal.throwIfAborted();
      await this.#failed(error, device, pixels);
      return undefined;
    } finally {
      own?.destroy();
    }
  }

  mark(png: Blob): Promise<Blob> {
    return markPng(png, { Software: 'Glanz', Denoised: this.#name });
  }

  destroy(): void {
    this.#limit = 0;
    this.#drop();
  }

  /** Whether an image that gets more samples is to be denoised. */
  #due(samples: number): boolean {
    const shown = this.#shown;
    return !shown || (samples >= 2 * shown.samples && performance.now() - this.#ended >= RENDERING * this.#cost);
  }

  async #run(denoiser: ImageDenoiser, tracer: PathTracer, signal: AbortSignal): Promise<DenoisedImage> {
    // Samples that came without, before they were requested or from a film that was kept, get them now.
    await tracer.setAovs(this.aovs(tracer.aovs));
    signal.throwIfAborted();
    return denoiser.denoiseTracer(tracer, { signal });
  }

  /** The denoiser of a device, made once. */
  #on(device: GPUDevice): Promise<ImageDenoiser> {
    if (this.#coming && device === this.#device) return this.#coming;
    this.#drop();
    this.#device = device;
    const coming = (this.#coming = this.#create(device));
    coming.then(
      (denoiser) => {
        if (coming === this.#coming) this.#denoiser = denoiser;
        else denoiser.destroy();
      },
      (error: unknown) => this.#failed(error, device, 0),
    );
    void device.lost.then(() => device === this.#device && this.#drop());
    return coming;
  }

  /** Frees what is on the device. */
  #drop(): void {
    this.forget();
    this.#denoiser?.destroy();
    this.#device = this.#coming = this.#denoiser = this.#tracer = undefined;
  }

  /** Images of so many pixels are shown with their noise from now on, unless the device was lost. */
  async #failed(error: unknown, device: GPUDevice, pixels: number): Promise<void> {
    // A loss may be reported after the errors that it causes.
    await soon();
    await soon();
    const { code, message } = (error ?? {}) as { readonly code?: unknown; readonly message?: string };
    if (device !== this.#device || pixels >= this.#limit || PASSING.has(code)) return;
    this.#limit = code === 'denoise/memory' ? pixels : 0;
    if (this.#limit === 0) this.#drop();
    else this.forget();
    if (this.#warned) return;
    this.#warned = true;
    this.#warn(
      new ViewerError('viewer/denoise', `The image is shown with its noise: ${message ?? String(error)}`, {
        cause: error,
      }),
    );
  }
}

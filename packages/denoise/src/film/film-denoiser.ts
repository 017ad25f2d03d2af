import { Denoiser } from '../denoiser';
import { DenoiseError } from '../error';
import { COPY_DST, COPY_SRC, STORAGE, UNIFORM, bindGroup, readImage, tryBuffers, type Kernel } from '../gpu';
import { checkSize } from '../images';
import { BLEND_TILE } from './blend_constants.wesl';
import { compileFilmKernels, type FilmKernels } from './kernels';
import type {
  DenoisableTracer,
  DenoisedFilm,
  DenoiseFilmOptions,
  FilmDenoiserOptions,
  FilmImages,
  FilmWeights,
} from './options';

/** From so many samples on a tracer knows the variance of its film. */
const VARIANCE_SAMPLES = 32;

/** Images that are copied, besides the film, where WebAssembly computes. */
const COPIED = ['albedo', 'normal', 'variance'] as const;

/** What is kept for images of a size. */
interface Buffers {
  readonly width: number;
  readonly height: number;
  readonly size: GPUBuffer;
  readonly film: GPUBuffer;
  readonly held: GPUBuffer;
  readonly denoised: GPUBuffer;
  readonly result: GPUBuffer;
  readonly tiles: GPUBuffer;
  /** In place of a variance that is not given. */
  readonly noVariance: GPUBuffer;
  /** Of {@link COPIED}; empty where shaders compute. */
  readonly copies: readonly GPUBuffer[];
}

/**
 * Denoises films of a path tracer, on GPU buffers: holds fireflies back, runs a network of Open Image Denoise, and blends
 * its image with the film by the estimated errors of both. Where the film's noise is not seen, the result is the film, so
 * that a converged film stays what it is. The film itself is only read.
 *
 * - Fireflies: a pixel that is more than 32 times as bright as the brightest of the 24 pixels around it is brought down
 *   to that for the network, which would spread it. Not-a-number and infinity count as black.
 * - The errors: over tiles of 8 × 8 pixels, the difference of film and denoised image is split into noise, which is
 *   independent from pixel to pixel, and the network's error, which a small blur leaves as it is; the film's own variance
 *   limits the noise where it is known. The share of the denoised image is noise / (noise + error + (0.08 L)²) with the
 *   luminance L, and 0 below a noise of 0.5 %.
 *
 * @example
 * const denoiser = await FilmDenoiser.create(device, { color: weights });
 * const { buffer } = await denoiser.denoiseTracer(tracer); // a PathTracer with aovs: ['albedo', 'normal']
 */
export class FilmDenoiser {
  readonly #device: GPUDevice;
  readonly #denoiser: Denoiser;
  readonly #kernels: FilmKernels;
  #buffers: Buffers | undefined;
  #last: Promise<unknown> = Promise.resolve();
  #destroyed = false;

  private constructor(device: GPUDevice, denoiser: Denoiser, kernels: FilmKernels) {
    this.#device = device;
    this.#denoiser = denoiser;
    this.#kernels = kernels;
  }

  /**
   * Reads the networks and compiles the kernels that do not depend on the image size.
   *
   * @param weights Whole archives; `FILM_WEIGHTS` names those of each quality. Nothing is downloaded.
   * @throws {DenoiseError} `denoise/weights`, `denoise/option`, `denoise/pipeline`.
   */
  static async create(
    device: GPUDevice,
    { color, albedo, normal }: FilmWeights,
    { signal, ...options }: FilmDenoiserOptions = {},
  ): Promise<FilmDenoiser> {
    const denoiser = await Denoiser.create(device, color, {
      ...options,
      ...(signal ? { signal } : {}),
      prefilter: { ...(albedo ? { albedo } : {}), ...(normal ? { normal } : {}) },
    });
    try {
      return new FilmDenoiser(device, denoiser, await compileFilmKernels(device));
    } catch (error) {
      denoiser.destroy();
      throw error;
    }
  }

  /** Bytes on the GPU, and of WebAssembly's memory where that is used: weights, and what the last size needs. */
  get memoryBytes(): number {
    const own = this.#buffers ? gpuBuffers(this.#buffers).reduce((sum, { size }) => sum + size, 0) : 0;
    return own + this.#denoiser.memoryBytes;
  }

  /**
   * Denoises a film. One at a time; later calls wait. Resolves when the GPU is done.
   *
   * @throws {DenoiseError} as `Denoiser.denoise` does; the signal's reason where it aborts.
   */
  denoise(images: FilmImages, options: DenoiseFilmOptions = {}): Promise<DenoisedFilm> {
    const result = this.#last.then(() => this.#run(images, options));
    this.#last = result.catch(() => undefined);
    return result;
  }

  /**
   * Denoises what a tracer has rendered so far. From 32 samples on its variance is used.
   *
   * @param tracer A `PathTracer` with the AOVs `albedo` and `normal`, on this device.
   * @throws {DenoiseError} `denoise/input` if an AOV is not requested; otherwise as {@link denoise}. What the tracer
   * throws.
   */
  async denoiseTracer(tracer: DenoisableTracer, options: DenoiseFilmOptions = {}): Promise<DenoisedFilm> {
    for (const name of ['albedo', 'normal'] as const)
      if (!tracer.aovs.includes(name))
        throw new DenoiseError(
          'denoise/input',
          `The tracer records no "${name}": create it with aovs: ['albedo', 'normal'], or await setAovs(['albedo', 'normal']).`,
        );
    const known = options.blend !== false && tracer.samples >= VARIANCE_SAMPLES;
    const variance = known ? await tracer.varianceBuffer() : undefined;
    options.signal?.throwIfAborted();
    const { width, height, beautyBuffer: color } = tracer;
    return this.denoise(
      { width, height, color, albedo: tracer.aov('albedo').buffer, normal: tracer.aov('normal').buffer, variance },
      options,
    );
  }

  /**
   * Copies a result to the CPU: linear RGBA, stride 4, top row first.
   *
   * @throws {DenoiseError} `denoise/destroyed`.
   */
  async read(image: DenoisedFilm): Promise<Float32Array<ArrayBuffer>> {
    this.#expectAlive();
    return readImage(this.#device, image);
  }

  /** Frees everything on the GPU; work that is under way ends with `denoise/destroyed`. */
  destroy(): void {
    this.#destroyed = true;
    this.#denoiser.destroy();
    this.#release();
  }

  #expectAlive(): void {
    if (this.#destroyed)
      throw new DenoiseError('denoise/destroyed', 'This FilmDenoiser was destroyed: create another one.');
  }

  #release(): void {
    if (this.#buffers) for (const buffer of gpuBuffers(this.#buffers)) buffer.destroy();
    this.#buffers = undefined;
  }

  /** @throws {DenoiseError} `denoise/memory`. */
  async #prepare(width: number, height: number): Promise<Buffers> {
    const kept = this.#buffers;
    // The last result may be on a screen: it stays until the next one.
    if (kept?.width === width && kept.height === height) return kept;
    const image = (name: string, usage: number, size = 16 * width * height) => ({
      label: `denoise ${name}`,
      size,
      usage: STORAGE | usage,
    });
    this.#release();
    const tiles = 16 * Math.ceil(width / BLEND_TILE) * Math.ceil(height / BLEND_TILE);
    const copied = this.#denoiser.kernels === 'webAssembly' ? COPIED : [];
    const [size, film, held, denoised, result, errorTiles, noVariance, ...copies] = (await this.#make(width, height, [
      { label: 'denoise size', size: 16, usage: UNIFORM | COPY_DST },
      image('film', COPY_DST),
      image('held', 0),
      image('denoised', COPY_SRC),
      image('result', COPY_SRC | COPY_DST),
      image('tiles', 0, tiles),
      image('no variance', 0, 16),
      ...copied.map((name) => image(name, COPY_DST)),
    ])) as [GPUBuffer, GPUBuffer, GPUBuffer, GPUBuffer, GPUBuffer, GPUBuffer, GPUBuffer, ...GPUBuffer[]];
    const buffers = { width, height, size, film, held, denoised, result, tiles: errorTiles, noVariance, copies };
    return (this.#buffers = buffers);
  }

  /** @throws {DenoiseError} `denoise/memory`, `denoise/destroyed`. */
  async #make(
    width: number,
    height: number,
    descriptors: readonly GPUBufferDescriptor[],
  ): Promise<readonly GPUBuffer[]> {
    const made = await tryBuffers(this.#device, descriptors);
    if (!made)
      throw new DenoiseError(
        'denoise/memory',
        `The GPU has no memory for the images of ${width} × ${height} pixels around the network: denoise a smaller image.`,
      );
    if (this.#destroyed) for (const buffer of made) buffer.destroy();
    this.#expectAlive();
    return made;
  }

  async #run(images: FilmImages, { blend = true, ...options }: DenoiseFilmOptions): Promise<DenoisedFilm> {
    options.signal?.throwIfAborted();
    this.#expectAlive();
    const { width, height, color, variance } = images;
    checkSize(width, height);
    const bytes = 16 * width * height;
    if (color.size < bytes || !(color.usage & STORAGE) || !(color.usage & COPY_SRC))
      throw new DenoiseError(
        'denoise/input',
        `"color" needs the usages STORAGE and COPY_SRC and ${bytes} bytes for ${width} × ${height} pixels; it has ${color.size}.`,
      );
    if (variance && (variance.size < bytes || !(variance.usage & STORAGE)))
      throw new DenoiseError(
        'denoise/input',
        `"variance" needs the usage STORAGE and ${bytes} bytes for ${width} × ${height} pixels; it has ${variance.size}.`,
      );
    const buffers = await this.#prepare(width, height);
    const { queue } = this.#device;
    queue.writeBuffer(buffers.size, 0, Uint32Array.of(width, height, variance ? 1 : 0, 0));
    const groups = [Math.ceil(width / 8), Math.ceil(height / 8)] as const;
    // The film may get samples meanwhile: all that follows sees the same one.
    const read = { albedo: images.albedo, normal: images.normal, variance };
    this.#submit((encoder) => {
      encoder.copyBufferToBuffer(color, 0, buffers.film, 0, bytes);
      // WebAssembly takes seconds, in which a tracer may show another view, or free its buffers.
      for (const [i, copy] of buffers.copies.entries()) {
        const name = COPIED[i]!;
        const image = read[name];
        // What is wrong with an image, the denoiser says.
        if (!image || image.size < bytes || !(image.usage & COPY_SRC)) continue;
        encoder.copyBufferToBuffer(image, 0, copy, 0, bytes);
        read[name] = copy;
      }
    });
    this.#dispatch(this.#kernels.fireflies, buffers, { 3: buffers.held }, groups);
    const { kernels } = await this.#denoiser.denoise(
      { width, height, color: buffers.held, albedo: read.albedo, normal: read.normal, output: buffers.denoised },
      options,
    );
    this.#expectAlive();
    if (!blend) return { buffer: buffers.denoised, width, height, kernels };
    const inputs = { 2: buffers.denoised, 4: read.variance ?? buffers.noVariance };
    this.#dispatch(this.#kernels.errors, buffers, { ...inputs, 3: buffers.tiles }, groups);
    this.#dispatch(this.#kernels.blend, buffers, { ...inputs, 3: buffers.result, 5: buffers.tiles }, groups);
    await queue.onSubmittedWorkDone();
    options.signal?.throwIfAborted();
    this.#expectAlive();
    return { buffer: buffers.result, width, height, kernels };
  }

  #submit(record: (encoder: GPUCommandEncoder) => void): void {
    const encoder = this.#device.createCommandEncoder({ label: 'denoise film' });
    record(encoder);
    this.#device.queue.submit([encoder.finish()]);
  }

  #dispatch(
    kernel: Kernel,
    { size, film }: Buffers,
    resources: Readonly<Record<number, GPUBuffer>>,
    groups: readonly [number, number],
  ): void {
    const windows = Object.entries({ 0: size, 1: film, ...resources }).map(
      ([binding, buffer]) => [binding, { buffer, offset: 0, size: buffer.size }] as const,
    );
    this.#submit((encoder) => {
      const pass = encoder.beginComputePass({ label: kernel.pipeline.label });
      pass.setPipeline(kernel.pipeline);
      pass.setBindGroup(0, bindGroup(this.#device, kernel, Object.fromEntries(windows)));
      pass.dispatchWorkgroups(...groups);
      pass.end();
    });
  }
}

const gpuBuffers = ({ width: _w, height: _h, ...buffers }: Buffers): GPUBuffer[] => Object.values(buffers).flat();

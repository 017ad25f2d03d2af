import { loadPart } from '@glanz/wgsl/error';
import type { Chain } from './chain';
import { checkOptions, readNetworks, wasmFor } from './configure';
import { DenoiseError } from './error';
import { lossOf } from './gpu';
import { checkSize } from './images';
import { JobCursor, costOf } from './jobs';
import type {
  DenoiseImages,
  DenoiseKernels,
  DenoiseOptions,
  DenoiseResult,
  DenoiserInput,
  DenoiserOptions,
  DenoiserPrepareOptions,
  DenoiserStorage,
} from './options';
import { Pace } from './pace';
import type { Shaders } from './shaders';
import type { NetworkOf } from './stages';
import type { StartedWasm, WasmChain } from './wasm/wasm-chain';

/**
 * Denoises images in GPU buffers by a network of Open Image Denoise. One network; images of any size, one at a time,
 * later calls wait. Memory and shaders for a size are created at its first use and kept until another size is used.
 *
 * @example
 * const denoiser = await Denoiser.create(device, weights, { input: 'hdr' });
 * await denoiser.denoise({ color, albedo, normal, output, width, height });
 */
export class Denoiser {
  readonly #device: GPUDevice;
  readonly #networks: readonly NetworkOf[];
  readonly #options: DenoiserOptions;
  /** `undefined` where shaders compute the layers. */
  readonly #wasm: StartedWasm | undefined;
  readonly #pace: Pace;
  /** Rejects when the device is lost. */
  readonly #lost: Promise<never>;
  /** What is denoised. */
  readonly input: DenoiserInput;
  /** Precision between layers where shaders compute them; in WebAssembly it is always single. */
  readonly storage: DenoiserStorage;
  /** Where WebAssembly computes the layers, they are made for encode(). */
  #shaders: Shaders | undefined;
  #chain: Chain | undefined;
  #wasmChain: WasmChain | undefined;
  #last: Promise<unknown> = Promise.resolve();
  #destroyed = false;

  private constructor(
    device: GPUDevice,
    networks: readonly NetworkOf[],
    options: DenoiserOptions,
    wasm: StartedWasm | undefined,
  ) {
    this.#device = device;
    this.input = options.input ?? 'hdr';
    this.storage = options.storage ?? 'f16';
    this.#pace = new Pace(options.maxSubmitMs ?? 8);
    this.#networks = networks;
    this.#options = options;
    this.#wasm = wasm;
    this.#lost = lossOf(device);
  }

  /**
   * Reads a network and compiles the kernels that do not depend on the image size.
   *
   * @param weights The whole content of a .tza file of Open Image Denoise. Nothing is downloaded.
   * @throws {DenoiseError} `denoise/weights`, `denoise/option`, `denoise/pipeline`. `GlanzError` `wgsl/chunk` where
   * what computes the layers cannot be loaded.
   */
  static async create(
    device: GPUDevice,
    weights: Uint8Array | ArrayBuffer,
    options: DenoiserOptions = {},
  ): Promise<Denoiser> {
    options.signal?.throwIfAborted();
    checkOptions(options);
    const networks = readNetworks(weights, options);
    const wasm = await wasmFor(device, networks, options);
    const denoiser = new Denoiser(device, networks, options, wasm);
    if (!wasm) await denoiser.#startShaders();
    options.signal?.throwIfAborted();
    return denoiser;
  }

  /** Channels that the network takes: 3 (the image), 6 (and albedo) or 9 (and normal). */
  get channels(): 3 | 6 | 9 {
    return this.#networks.at(-1)![1].channels;
  }

  /**
   * What computes the layers. Shaders do nevertheless where WebAssembly's memory is refused, see
   * {@link DenoiseResult.kernels}.
   */
  get kernels(): DenoiseKernels {
    return this.#wasm ? 'webAssembly' : 'shaders';
  }

  /** Bytes on the GPU, and of WebAssembly's memory where that is used: weights, and what the last size needs. */
  get memoryBytes(): number {
    return [this.#shaders, this.#chain, this.#wasmChain].reduce((sum, owner) => sum + (owner?.bytes ?? 0), 0);
  }

  /**
   * Makes what {@link denoise} needs for images of a size, so that the first one does not wait for it: memory, and
   * shaders unless WebAssembly computes the layers. For {@link encode} pass `encode: true`, which makes those there
   * too.
   *
   * @throws {DenoiseError} `denoise/size`, `denoise/memory`, `denoise/limit`, `denoise/pipeline`, `denoise/destroyed`.
   */
  prepare(width: number, height: number, { encode = false }: DenoiserPrepareOptions = {}): Promise<void> {
    return this.#inTurn(async () => {
      checkSize(width, height);
      const wasm = await this.#prepareWasm(width, height);
      if (!wasm || encode) await this.#prepare(width, height);
    });
  }

  /**
   * Denoises an image, in submissions of about `maxSubmitMs` each, or in WebAssembly in slices of about 6 ms. Resolves
   * when the GPU is done.
   *
   * @throws {DenoiseError} `denoise/size`, `denoise/input`, `denoise/option`, `denoise/memory`, `denoise/limit`,
   * `denoise/pipeline`, `denoise/device`, `denoise/destroyed`; the signal's reason where it aborts.
   */
  denoise(images: DenoiseImages, options: DenoiseOptions = {}): Promise<DenoiseResult> {
    return this.#inTurn(async () => {
      options.signal?.throwIfAborted();
      const { width, height } = images;
      checkSize(width, height);
      const wasm = await this.#prepareWasm(width, height);
      if (!wasm) return this.#run(await this.#prepare(width, height), images, options);
      const { signal, onProgress } = options;
      const run = { signal, onProgress, expectAlive: () => this.#expectAlive(), lost: this.#lost };
      return { tiles: wasm.tiles, submissions: await wasm.run(images, run), kernels: 'webAssembly' };
    });
  }

  /**
   * Records all work into a command encoder of the application, which may have its own frame loop. Uniforms are written
   * on the queue, ahead of the encoder: submit it before the next call of any method.
   *
   * @throws {DenoiseError} as {@link denoise} does; `denoise/size` too where {@link prepare} was not called for this
   * size before, with `encode: true`.
   */
  encode(encoder: GPUCommandEncoder, images: DenoiseImages): void {
    this.#expectAlive();
    checkSize(images.width, images.height);
    if (!this.#chain)
      throw new DenoiseError(
        'denoise/size',
        'No shaders are prepared: await prepare(width, height, { encode: true }) before encode().',
      );
    const jobs = this.#chain.jobs(images);
    const pass = encoder.beginComputePass({ label: 'denoise' });
    new JobCursor(jobs).encode(pass, Infinity);
    pass.end();
  }

  /** Frees everything; work that is under way ends with `denoise/destroyed`. */
  destroy(): void {
    this.#destroyed = true;
    for (const owner of [this.#shaders, this.#chain, this.#wasmChain]) owner?.destroy();
    this.#shaders = this.#chain = this.#wasmChain = undefined;
  }

  #expectAlive(): void {
    if (this.#destroyed)
      throw new DenoiseError('denoise/destroyed', 'This Denoiser was destroyed: create another one.');
  }

  #inTurn<T>(work: () => Promise<T>): Promise<T> {
    const result = this.#last.then(async () => {
      this.#expectAlive();
      return work();
    });
    this.#last = result.catch(() => undefined);
    return result;
  }

  async #prepare(width: number, height: number): Promise<Chain> {
    if (this.#chain?.width === width && this.#chain.height === height) return this.#chain;
    this.#chain?.destroy();
    this.#chain = undefined;
    const shaders = await this.#startShaders();
    const chain = await shaders.chain(width, height);
    if (this.#destroyed) chain.destroy();
    this.#expectAlive();
    this.#chain = chain;
    return chain;
  }

  /** @returns `undefined` where shaders compute the layers, or WebAssembly's memory is refused: then they do. */
  async #prepareWasm(width: number, height: number): Promise<WasmChain | undefined> {
    // A chain of shaders alone is there where memory was refused for this size.
    const made = this.#wasmChain ?? this.#chain;
    if (!this.#wasm || (made?.width === width && made.height === height)) return this.#wasmChain;
    // Shaders of another size are not of use to encode() any more.
    for (const chain of [this.#wasmChain, this.#chain]) chain?.destroy();
    this.#wasmChain = this.#chain = undefined;
    const chain = await this.#wasm({ width, height, maxMemory: this.#options.maxMemory });
    if (this.#destroyed) chain?.destroy();
    this.#expectAlive();
    return (this.#wasmChain = chain);
  }

  async #startShaders(): Promise<Shaders> {
    if (this.#shaders) return this.#shaders;
    const { Shaders } = await loadPart('shaders', import('./shaders'));
    const shaders = await Shaders.create(this.#device, this.#networks, this.#options);
    if (this.#destroyed) shaders.destroy();
    this.#expectAlive();
    return (this.#shaders = shaders);
  }

  async #run(chain: Chain, images: DenoiseImages, { signal, onProgress }: DenoiseOptions): Promise<DenoiseResult> {
    const jobs = chain.jobs(images);
    const total = costOf(jobs);
    const cursor = new JobCursor(jobs);
    let submissions = 0;
    let spent = 0;
    let ended = performance.now();
    let before: Promise<void> | undefined;
    while (!cursor.done) {
      signal?.throwIfAborted();
      this.#expectAlive();
      const encoder = this.#device.createCommandEncoder({ label: 'denoise' });
      const pass = encoder.beginComputePass({ label: 'denoise' });
      const work = cursor.encode(pass, this.#pace.work);
      pass.end();
      this.#device.queue.submit([encoder.finish()]);
      submissions++;
      const started = performance.now();
      const done = Promise.race([this.#device.queue.onSubmittedWorkDone(), this.#lost]).then(() => {
        const now = performance.now();
        this.#pace.measured(work, now - Math.max(started, ended));
        ended = now;
        spent += work;
        onProgress?.(Math.min(1, spent / total));
      });
      done.catch(() => undefined);
      // One submission waits while another one runs: the GPU is never idle.
      await before;
      before = done;
    }
    await before;
    this.#expectAlive();
    return { tiles: chain.tiles, submissions, kernels: 'shaders' };
  }
}

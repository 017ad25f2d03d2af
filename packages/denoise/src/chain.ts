import { DenoiseError } from './error';
import type { Job } from './jobs';
import type { Kernel } from './gpu';
import { allocate, type PrepareOptions } from './memory';
import type { Network } from './network';
import { NetworkKernels } from './network-kernels';
import { Prepared } from './prepared';
import type { DenoiseImages, DenoiserInput, DenoiserStorage } from './options';
import { boundChain, type Stage } from './stages';

/** A network that shaders evaluate. */
export interface ShaderStage extends Stage {
  readonly kernels: NetworkKernels;
}

/** The networks that a denoiser evaluates one after the other: those that clean guides, then the one for the image. */
export function makeStages(
  device: GPUDevice,
  networks: readonly (readonly [DenoiserInput, Network])[],
  storage: DenoiserStorage,
): ShaderStage[] {
  const shared = new Map<string, Promise<Kernel>>();
  return networks.map(([input, network]) => ({
    input,
    network,
    kernels: new NetworkKernels(device, network, input, storage, shared),
  }));
}

/** All stages, ready for images of a size. */
export class Chain {
  readonly #device: GPUDevice;
  readonly #stages: readonly ShaderStage[];
  readonly #prepared: Prepared[] = [];
  readonly #buffers: readonly GPUBuffer[];
  readonly #guides: readonly GPUBuffer[];
  readonly width: number;
  readonly height: number;

  private constructor(
    device: GPUDevice,
    stages: readonly ShaderStage[],
    { width, height }: PrepareOptions,
    { buffers, images }: { buffers: readonly GPUBuffer[]; images: readonly GPUBuffer[] },
  ) {
    this.#device = device;
    this.#stages = stages;
    this.#buffers = buffers;
    this.#guides = images;
    this.width = width;
    this.height = height;
  }

  /** @throws {DenoiseError} `denoise/memory`, `denoise/limit`, `denoise/pipeline`. */
  static async create(device: GPUDevice, stages: readonly ShaderStage[], options: PrepareOptions): Promise<Chain> {
    const memory = await allocate(
      device,
      stages.map(({ network }) => network),
      stages.length - 1,
      options,
    );
    const chain = new Chain(device, stages, options, memory);
    try {
      for (const [i, { kernels }] of stages.entries())
        chain.#prepared.push(await Prepared.create(device, kernels, options, memory.parts[i]!, memory.buffers));
    } catch (error) {
      chain.destroy();
      throw error;
    }
    return chain;
  }

  /** Bytes on the GPU. */
  get bytes(): number {
    return [...this.#buffers, ...this.#guides, ...this.#prepared].reduce(
      (sum, owner) => sum + ('size' in owner ? owner.size : owner.bytes),
      0,
    );
  }

  /** Tiles that the image is cut into; with several networks, the most. */
  get tiles(): number {
    return Math.max(...this.#prepared.map(({ tiling }) => tiling.tiles.length));
  }

  /**
   * The dispatches that denoise these images. Writes uniforms: one image at a time.
   *
   * @throws {DenoiseError} `denoise/size`, `denoise/input`, `denoise/limit`, `denoise/option`.
   */
  jobs(images: DenoiseImages): Job[] {
    if (images.width !== this.width || images.height !== this.height)
      throw new DenoiseError(
        'denoise/size',
        `Nothing is prepared for ${images.width} × ${images.height} pixels: await prepare(${images.width}, ${images.height}, { encode: true }) before encode().`,
      );
    const bound = boundChain(this.#device, this.#stages, this.#guides, images);
    // Where all of them are right: nothing has been written before an error.
    return bound.flatMap((one, i) => this.#prepared[i]!.jobs(one));
  }

  destroy(): void {
    for (const owner of [...this.#buffers, ...this.#guides, ...this.#prepared]) owner.destroy();
  }
}

import { DenoiseError } from './error';
import { bindImages, type BoundImages } from './images';
import type { Job } from './jobs';
import type { Kernel } from './gpu';
import { allocate, type PrepareOptions } from './memory';
import type { Network } from './network';
import { NetworkKernels } from './network-kernels';
import { Prepared } from './prepared';
import type { DenoiseImages, DenoiserInput, DenoiserStorage } from './options';

/** A network on the device: what it denoises, its shaders and weights. */
export interface Stage {
  readonly input: DenoiserInput;
  readonly network: Network;
  readonly kernels: NetworkKernels;
}

/** Guides that are cleaned before they guide. */
export type CleanGuide = 'albedo' | 'normal';

/** The networks that a denoiser evaluates one after the other: those that clean guides, then the one for the image. */
export function makeStages(
  device: GPUDevice,
  networks: readonly (readonly [DenoiserInput, Network])[],
  storage: DenoiserStorage,
): Stage[] {
  const shared = new Map<string, Promise<Kernel>>();
  return networks.map(([input, network]) => ({
    input,
    network,
    kernels: new NetworkKernels(device, network, input, storage, shared),
  }));
}

/**
 * The images of each stage, checked: those that clean guides write into `guides`, the last takes what they have written.
 *
 * @throws {DenoiseError} `denoise/size`, `denoise/input`, `denoise/limit`, `denoise/option`.
 */
export function boundChain(
  device: GPUDevice,
  stages: readonly Stage[],
  guides: readonly GPUBuffer[],
  images: DenoiseImages,
): BoundImages[] {
  const cleaned: Partial<Record<CleanGuide, { buffer: GPUBuffer; pixelStride: 3 }>> = {};
  return stages.map(({ input, network }, i) => {
    const guide = guides[i];
    if (guide) cleaned[input as CleanGuide] = { buffer: guide, pixelStride: 3 };
    const taken = guide ? { ...images, output: { buffer: guide, pixelStride: 3 } } : { ...images, ...cleaned };
    return bindImages(network, input, taken, device.limits);
  });
}

/** All stages, ready for images of a size. */
export class Chain {
  readonly #device: GPUDevice;
  readonly #stages: readonly Stage[];
  readonly #prepared: Prepared[] = [];
  readonly #buffers: readonly GPUBuffer[];
  readonly #guides: readonly GPUBuffer[];
  readonly width: number;
  readonly height: number;

  private constructor(
    device: GPUDevice,
    stages: readonly Stage[],
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
  static async create(device: GPUDevice, stages: readonly Stage[], options: PrepareOptions): Promise<Chain> {
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
        `Nothing is prepared for ${images.width} × ${images.height} pixels: await prepare() with this size before encode().`,
      );
    const bound = boundChain(this.#device, this.#stages, this.#guides, images);
    // Where all of them are right: nothing has been written before an error.
    return bound.flatMap((one, i) => this.#prepared[i]!.jobs(one));
  }

  destroy(): void {
    for (const owner of [...this.#buffers, ...this.#guides, ...this.#prepared]) owner.destroy();
  }
}

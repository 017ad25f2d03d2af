import { Chain, makeStages, type ShaderStage } from './chain';
import type { DenoiseError } from './error';
import type { DeviceMatrices } from './kernels/shapes';
import { matricesFor, shapesOf } from './layer-shapes';
import type { DenoiserOptions } from './options';
import type { NetworkOf } from './stages';

/** Networks that shaders evaluate: what is kept for images of all sizes. */
export class Shaders {
  readonly #device: GPUDevice;
  readonly #options: DenoiserOptions;
  readonly #stages: readonly ShaderStage[];
  /** `undefined` where the device has none, or the driver does not compile their kernels. */
  #matrices: DeviceMatrices | undefined;

  private constructor(
    device: GPUDevice,
    networks: readonly NetworkOf[],
    options: DenoiserOptions,
    matrices: DeviceMatrices | undefined,
  ) {
    this.#device = device;
    this.#options = options;
    this.#stages = makeStages(device, networks, options.storage ?? 'f16');
    this.#matrices = matrices;
  }

  /**
   * Compiles the kernels that do not depend on the image size.
   *
   * @throws {DenoiseError} `denoise/pipeline`.
   */
  static async create(device: GPUDevice, networks: readonly NetworkOf[], options: DenoiserOptions): Promise<Shaders> {
    const shaders = new Shaders(device, networks, options, await matricesFor(device, options));
    await Promise.all(shaders.#stages.map(({ kernels }) => kernels.prelude()));
    return shaders;
  }

  /** Bytes of weights on the GPU. */
  get bytes(): number {
    return this.#stages.reduce((sum, { kernels }) => sum + kernels.bytes, 0);
  }

  /**
   * Makes memory and compiles kernels for images of a size.
   *
   * @throws {DenoiseError} `denoise/memory`, `denoise/limit`, `denoise/pipeline`.
   */
  async chain(width: number, height: number): Promise<Chain> {
    const { storage, maxMemory = 2 ** 30, shapeOf } = this.#options;
    try {
      return await Chain.create(this.#device, this.#stages, {
        width,
        height,
        maxMemory,
        texelBytes: storage === 'f32' ? 16 : 8,
        maxBinding: this.#device.limits.maxStorageBufferBindingSize,
        shapeOf: shapesOf(this.#device, shapeOf, this.#matrices),
      });
    } catch (error) {
      if (!this.#matrices || (error as DenoiseError).code !== 'denoise/pipeline') throw error;
      // Matrices are experimental: where a driver does not compile their kernels, threads do the work.
      this.#matrices = undefined;
      return this.chain(width, height);
    }
  }

  destroy(): void {
    for (const { kernels } of this.#stages) kernels.destroy();
  }
}

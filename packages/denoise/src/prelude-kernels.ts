import { compileKernel, type BindingKind, type Kernel } from './gpu';
import encode from './kernels/encode.wesl';
import exposure from './kernels/exposure.wesl';
import type { Network } from './network';
import type { DenoiserInput, DenoiserStorage } from './options';

/** What runs before the first layer. */
export interface Prelude {
  readonly exposure: Kernel;
  readonly scale: Kernel;
  readonly encode: Kernel;
}

/** The shaders before the layers of a network, made at first use and kept. */
export class PreludeKernels {
  protected readonly device: GPUDevice;
  readonly #network: Network;
  /** Gates of the shaders, by what the network takes and returns, and by the storage. */
  readonly flags: Readonly<Record<string, boolean>>;
  #prelude: Promise<Prelude> | undefined;

  constructor(device: GPUDevice, network: Network, input: DenoiserInput, storage: DenoiserStorage) {
    this.device = device;
    this.#network = network;
    this.flags = {
      DENOISE_HALF: storage === 'f16',
      DENOISE_F16: storage === 'f16' && device.features.has('shader-f16'),
      DENOISE_HDR: input === 'hdr',
      DENOISE_NORMAL: input === 'normal',
      DENOISE_LINEAR: input === 'ldr' || input === 'albedo',
      DENOISE_GUIDE_ALBEDO: network.channels >= 6,
      DENOISE_GUIDE_NORMAL: network.channels >= 9,
    };
  }

  /** @throws {DenoiseError} `denoise/pipeline`. */
  prelude(): Promise<Prelude> {
    this.#prelude ??= this.#compilePrelude();
    this.#prelude.catch(() => (this.#prelude = undefined));
    return this.#prelude;
  }

  async #compilePrelude(): Promise<Prelude> {
    const bindings: Record<number, BindingKind> = {
      0: 'uniform',
      1: 'dynamic',
      5: 'write',
      6: 'dynamic',
      7: 'read',
      8: 'read',
    };
    if (this.#network.channels >= 6) bindings[3] = 'read';
    if (this.#network.channels >= 9) bindings[4] = 'read';
    const compile = (label: string, ...rest: readonly [Record<number, BindingKind>, string]) =>
      compileKernel(this.device, label, exposure, this.flags, ...rest);
    const [blocks, scale, encoding] = await Promise.all([
      compile('denoise exposure', { 2: 'write', 6: 'dynamic', 7: 'read' }, 'measure_block'),
      compile('denoise scale', { 2: 'write', 5: 'write', 6: 'dynamic' }, 'find_scale'),
      compileKernel(this.device, 'denoise encode', encode, this.flags, bindings),
    ]);
    return { exposure: blocks, scale, encode: encoding };
  }
}

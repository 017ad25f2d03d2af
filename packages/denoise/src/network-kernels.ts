import { STORAGE, compileKernel, filledBuffer, type BindingKind, type Kernel } from './gpu';
import { convolutionModule } from './kernels/convolution.wgsl';
import encode from './kernels/encode.wesl';
import exposure from './kernels/exposure.wesl';
import { hasMatrices, shapeName, tileOutputs } from './kernels/shapes';
import type { Network } from './network';
import type { DenoiserInput, DenoiserStorage } from './options';
import { packWeights, type PackedWeights } from './pack-weights';
import type { LayerPlan } from './plan';

/** What runs before the first layer. */
export interface Prelude {
  readonly exposure: Kernel;
  readonly scale: Kernel;
  readonly encode: Kernel;
}

/** The shaders and weights of a network on a device, made at first use and kept. */
export class NetworkKernels {
  readonly #device: GPUDevice;
  readonly #network: Network;
  /** Gates of the shaders, by what the network takes and returns, and by the storage. */
  readonly flags: Readonly<Record<string, boolean>>;
  readonly #input: DenoiserInput;
  readonly #convolutions: Map<string, Promise<Kernel>>;
  readonly #weights = new Map<string, { readonly buffer: GPUBuffer; readonly packed: PackedWeights }>();
  readonly #preludes = new Map<DenoiserStorage | undefined, Promise<Prelude>>();

  /** @param convolutions Shaders that networks with the same storage share. */
  constructor(
    device: GPUDevice,
    network: Network,
    input: DenoiserInput,
    storage: DenoiserStorage,
    convolutions: Map<string, Promise<Kernel>>,
  ) {
    this.#device = device;
    this.#network = network;
    this.#input = input;
    this.#convolutions = convolutions;
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

  /** Bytes of weights on the GPU. */
  get bytes(): number {
    return [...this.#weights.values()].reduce((sum, { buffer }) => sum + buffer.size, 0);
  }

  /**
   * @param storage `f32` where it encodes in single precision whatever the layers' storage is.
   * @throws {DenoiseError} `denoise/pipeline`.
   */
  prelude(storage?: 'f32'): Promise<Prelude> {
    let prelude = this.#preludes.get(storage);
    if (!prelude) {
      const single = storage && { DENOISE_HALF: false, DENOISE_F16: false };
      prelude = this.#compilePrelude({ ...this.flags, ...single });
      this.#preludes.set(storage, prelude);
      prelude.catch(() => this.#preludes.delete(storage));
    }
    return prelude;
  }

  async #compilePrelude(flags: Readonly<Record<string, boolean>>): Promise<Prelude> {
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
      compileKernel(this.#device, label, exposure, flags, ...rest);
    const [blocks, scale, encoding] = await Promise.all([
      compile('denoise exposure', { 2: 'write', 6: 'dynamic', 7: 'read' }, 'measure_block'),
      compile('denoise scale', { 2: 'write', 5: 'write', 6: 'dynamic' }, 'find_scale'),
      compileKernel(this.#device, 'denoise encode', encode, flags, bindings),
    ]);
    return { exposure: blocks, scale, encode: encoding };
  }

  /** @throws {DenoiseError} `denoise/pipeline`. */
  convolution({ layer, shape, result }: LayerPlan): Promise<Kernel> {
    const up = layer.up !== undefined;
    const last = result === undefined;
    // Kernels differ by how many channels the last vector of a source holds.
    const rest = layer.directChannels % 4;
    const key = `${shapeName(shape)}${up ? ', upsampled' : ''}${rest === 0 ? '' : `, ${rest} of 4 channels`}${layer.pool ? ', pooled' : ''}${last ? `, last, ${this.#input}` : ''}`;
    let kernel = this.#convolutions.get(key);
    if (!kernel) {
      const bindings: Record<number, BindingKind> = { 0: 'uniform', 1: 'dynamic', 2: 'read', 3: 'read', 5: 'write' };
      if (up) bindings[4] = 'read';
      if (last) Object.assign(bindings, { 6: 'dynamic', 7: 'read', 8: 'read' });
      if (hasMatrices(shape)) bindings[6] = 'read';
      const module = hasMatrices(shape)
        ? shape.code.convolution({ shape, pool: layer.pool })
        : convolutionModule({ shape, up, directChannels: layer.directChannels, pool: layer.pool, last });
      kernel = compileKernel(this.#device, `denoise ${key}`, module, this.flags, bindings);
      this.#convolutions.set(key, kernel);
      // A failure is not kept: the next call tries again.
      kernel.catch(() => this.#convolutions.delete(key));
    }
    return kernel;
  }

  /** A layer's weights, packed for its shape. */
  weights({ layer, shape }: LayerPlan): { readonly buffer: GPUBuffer; readonly packed: PackedWeights } {
    const multiple = tileOutputs(shape);
    const matrices = hasMatrices(shape) ? shape : undefined;
    const key = `${layer.name} ${multiple}${matrices ? ' in matrices' : ''}`;
    let known = this.#weights.get(key);
    if (!known) {
      const packed = matrices ? matrices.code.pack(layer, multiple, matrices.matrix) : packWeights(layer, multiple);
      known = {
        buffer: filledBuffer(this.#device, `denoise ${layer.name}`, packed.data.buffer as ArrayBuffer, STORAGE),
        packed,
      };
      this.#weights.set(key, known);
    }
    return known;
  }

  destroy(): void {
    for (const { buffer } of this.#weights.values()) buffer.destroy();
    this.#weights.clear();
  }
}

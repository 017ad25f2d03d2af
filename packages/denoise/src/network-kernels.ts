import { STORAGE, compileKernel, filledBuffer, type BindingKind, type Kernel } from './gpu';
import { convolutionModule } from './kernels/convolution.wgsl';
import { hasMatrices, shapeName, tileOutputs } from './kernels/shapes';
import type { Network } from './network';
import type { DenoiserInput, DenoiserStorage } from './options';
import { packWeights, type PackedWeights } from './pack-weights';
import type { LayerPlan } from './plan';
import { PreludeKernels } from './prelude-kernels';

/** The shaders and weights of a network on a device, made at first use and kept. */
export class NetworkKernels extends PreludeKernels {
  readonly #input: DenoiserInput;
  readonly #convolutions: Map<string, Promise<Kernel>>;
  readonly #weights = new Map<string, { readonly buffer: GPUBuffer; readonly packed: PackedWeights }>();

  /** @param convolutions Shaders that networks with the same storage share. */
  constructor(
    device: GPUDevice,
    network: Network,
    input: DenoiserInput,
    storage: DenoiserStorage,
    convolutions: Map<string, Promise<Kernel>>,
  ) {
    super(device, network, input, storage);
    this.#input = input;
    this.#convolutions = convolutions;
  }

  /** Bytes of weights on the GPU. */
  get bytes(): number {
    return [...this.#weights.values()].reduce((sum, { buffer }) => sum + buffer.size, 0);
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
      kernel = compileKernel(this.device, `denoise ${key}`, module, this.flags, bindings);
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
        buffer: filledBuffer(this.device, `denoise ${layer.name}`, packed.data.buffer as ArrayBuffer, STORAGE),
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

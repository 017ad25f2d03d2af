import type { KernelName } from '../integrator/pipelines';
import { FEATURE_SAMPLES } from './feature-pass';
import type { FeatureLayer } from '../film/layers';

/**
 * The kernel that makes a layer, and the film buffers that it is made of, in the order in which {@link unpackLayer}
 * takes them.
 */
const LAYER_SOURCES: Readonly<
  Record<FeatureLayer, { readonly kernel: KernelName; readonly buffers: readonly string[] }>
> = {
  albedo: { kernel: 'features', buffers: ['feature_albedo'] },
  normal: { kernel: 'features', buffers: ['feature_normal'] },
  position: { kernel: 'position', buffers: ['feature_position'] },
  depth: { kernel: 'features', buffers: ['feature_normal', 'feature_albedo'] },
  objectId: { kernel: 'features', buffers: ['feature_ids'] },
  materialId: { kernel: 'features', buffers: ['feature_ids'] },
};

/** What {@link FeatureLayers} reads through. */
export interface FeatureSource {
  /** Adds up a kernel's layers again, over so many samples. */
  render(kernel: KernelName, samples: number): Promise<void>;
  /** Copies a buffer of the film. */
  copy(name: string): Promise<ArrayBuffer>;
}

/**
 * The layers of the image as it is that come from camera rays alone: rendered when they are first read, and again
 * where more samples are known.
 */
export class FeatureLayers {
  readonly #source: FeatureSource;
  readonly #passes = new Map<KernelName, { readonly samples: number; readonly done: Promise<void> }>();

  constructor(source: FeatureSource) {
    this.#source = source;
  }

  /** The image is another one. */
  clear(): void {
    this.#passes.clear();
  }

  /** @param samples Of the image, which the layer need not have more than. */
  async read(layer: FeatureLayer, samples: number): Promise<Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>> {
    const { kernel, buffers } = LAYER_SOURCES[layer];
    const wanted = Math.min(FEATURE_SAMPLES, Math.max(1, samples));
    // Layers read at the same time share one pass.
    let pass = this.#passes.get(kernel);
    if (!pass || pass.samples < wanted)
      this.#passes.set(kernel, (pass = { samples: wanted, done: this.#render(kernel, wanted, pass?.done) }));
    try {
      await pass.done;
    } catch (error) {
      // The next read tries again.
      if (this.#passes.get(kernel) === pass) this.#passes.delete(kernel);
      throw error;
    }
    const copies = await Promise.all(buffers.map((name) => this.#source.copy(name)));
    const { unpackLayer } = await import('../film/film-data');
    return unpackLayer(layer, copies, pass.samples);
  }

  async #render(kernel: KernelName, samples: number, after: Promise<void> | undefined): Promise<void> {
    await after?.catch(() => {});
    await this.#source.render(kernel, samples);
  }
}

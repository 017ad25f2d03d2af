import type { PathTracer } from '@glanz/renderer';
import type { Layer } from '../output/layers';

/** A layer is read again whenever there are so many times more samples, up to the maximum that layers average. */
const GROWTH = 4;
const MAX_SAMPLES = 64;

/** What the layer view looks at. */
export interface LayerSource {
  readonly tracer: () => PathTracer | undefined;
  /** Whether the film holds a sample since it was last cleared. */
  readonly fresh: () => boolean;
  readonly report: (error: unknown) => void;
  /** The name of what is on the screen. */
  readonly shown: (layer: Layer) => void;
}

/** Shows a layer of the film over the image, and reads it again as it gets better. */
export class LayerView {
  readonly #source: LayerSource;
  readonly #canvas: HTMLCanvasElement;
  #requested: Layer;
  #busy = false;
  #next = 1;

  /** @param canvas Lies over the image. */
  constructor(source: LayerSource, canvas: HTMLCanvasElement, layer: Layer) {
    this.#source = source;
    this.#canvas = canvas;
    this.#requested = layer;
    canvas.hidden = true;
    source.shown('beauty');
  }

  choose(layer: Layer): void {
    if (layer === this.#requested) return;
    this.#requested = layer;
    if (layer === 'beauty') {
      this.#canvas.hidden = true;
      this.#source.shown('beauty');
    } else void this.#read();
  }

  /** The film was cleared. */
  restarted(): void {
    this.#next = 1;
  }

  progressed(samples: number): void {
    if (samples < this.#next || this.#next > MAX_SAMPLES) return;
    this.#next = samples * GROWTH;
    void this.#read();
  }

  async #read(): Promise<void> {
    const tracer = this.#source.tracer();
    const layer = this.#requested;
    if (!tracer || layer === 'beauty' || this.#busy || !this.#source.fresh()) return;
    this.#busy = true;
    try {
      const { width, height } = tracer;
      const [{ layerPixels }, data] = await Promise.all([import('../output/layer-image'), tracer.read(layer)]);
      if (tracer !== this.#source.tracer() || tracer.width !== width || tracer.height !== height) return;
      if (layer !== this.#requested) return;
      this.#canvas.width = width;
      this.#canvas.height = height;
      this.#canvas.getContext('2d')?.putImageData(layerPixels(layer, data, width, height), 0, 0);
      this.#canvas.hidden = false;
      this.#source.shown(layer);
    } catch (error) {
      if (tracer === this.#source.tracer()) this.#source.report(error);
    } finally {
      this.#busy = false;
    }
    // Another one was chosen meanwhile.
    if (layer !== this.#requested) void this.#read();
  }
}

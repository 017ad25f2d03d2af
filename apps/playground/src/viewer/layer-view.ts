import type { PathTracer } from '@glanz/renderer';
import { layerPicture, type Layer } from '../output/layers';
import type { Display } from './display';

/** A layer is read again whenever there are so many times more samples, up to the most that layers average. */
const GROWTH = 4;
const MOST = 64;

/** What the layer view looks at. */
export interface LayerSource {
  readonly tracer: () => PathTracer | undefined;
  readonly display: () => Display;
  /** Whether the film holds a sample since it was last cleared. */
  readonly fresh: () => boolean;
  readonly redraw: () => void;
  readonly report: (error: unknown) => void;
}

/** Shows a layer of the film in place of the beauty, and reads it again as it gets better. */
export class LayerView {
  readonly #source: LayerSource;
  #wanted: Layer;
  #shown: Layer = 'beauty';
  #busy = false;
  #next = 1;

  constructor(source: LayerSource, layer: Layer) {
    this.#source = source;
    this.#wanted = layer;
  }

  /** Name of what the canvas shows. */
  get shown(): Layer {
    return this.#source.display().showsLayer ? this.#shown : 'beauty';
  }

  choose(layer: Layer): void {
    this.#wanted = layer;
    if (layer === 'beauty') {
      this.#source.display().setLayer(undefined, [1, 1]);
      this.#source.redraw();
    } else void this.#read();
  }

  /** The film was cleared. */
  restarted(): void {
    this.#next = 1;
  }

  progressed(samples: number): void {
    if (samples < this.#next || this.#next > MOST) return;
    this.#next = samples * GROWTH;
    void this.#read();
  }

  async #read(): Promise<void> {
    const tracer = this.#source.tracer();
    const display = this.#source.display();
    const layer = this.#wanted;
    if (!tracer || layer === 'beauty' || this.#busy || !this.#source.fresh()) return;
    this.#busy = true;
    try {
      const { width, height } = tracer;
      const picture = layerPicture(layer, await tracer.read(layer));
      if (tracer !== this.#source.tracer() || picture.length !== width * height * 4) return;
      if (layer === this.#wanted) {
        display.setLayer(picture, [width, height]);
        this.#shown = layer;
        this.#source.redraw();
      }
    } catch (error) {
      if (tracer === this.#source.tracer()) this.#source.report(error);
    } finally {
      this.#busy = false;
    }
    // Another one was chosen meanwhile.
    if (layer !== this.#wanted) void this.#read();
  }
}

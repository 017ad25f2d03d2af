import { AOV_SAMPLES } from '../film/aovs';
import type { Batch } from '../schedule/scheduler';

/**
 * How far a film's AOVs have come. They are running means, so every sample of a pixel must come once and in the order of
 * their numbers: of a batch, the samples that follow the last recorded one are recorded.
 */
export class AovProgress {
  readonly #first: number;
  readonly #pixels: number;
  #sample: number;
  /** Pixels, from the first on, that have the sample too. */
  #pixel = 0;

  /**
   * @param first Number of the film's first sample.
   * @param pixels Pixels of the film.
   */
  constructor(first: number, pixels: number) {
    this.#first = this.#sample = first;
    this.#pixels = pixels;
  }

  /** Samples that all pixels have. */
  get samples(): number {
    return this.#sample - this.#first;
  }

  /**
   * The samples of a batch over all pixels that are to be recorded, which count as recorded then.
   * @returns The number of the first one and of the one after the last; `undefined`: there are none.
   */
  take({ pixelOffset, pixelCount, sampleOffset, sampleCount }: Batch): readonly [number, number] | undefined {
    const begin = this.#sample;
    const end = Math.min(sampleOffset + sampleCount, this.#first + AOV_SAMPLES);
    if (pixelOffset !== this.#pixel || sampleOffset > begin || end <= begin) return undefined;
    this.#pixel += pixelCount;
    if (this.#pixel >= this.#pixels) {
      this.#pixel = 0;
      this.#sample = end;
    }
    return [begin, end];
  }

  /**
   * The next batch on the way to a number of samples, or `undefined` when they are there.
   * @param paths Paths that a batch may hold.
   */
  next(samples: number, paths: number): Batch | undefined {
    const missing = Math.min(samples, AOV_SAMPLES) - this.samples;
    if (missing <= 0) return undefined;
    const [pixelOffset, sampleOffset] = [this.#pixel, this.#sample];
    if (pixelOffset > 0 || paths < 2 * this.#pixels)
      return { pixelOffset, pixelCount: Math.min(paths, this.#pixels - pixelOffset), sampleOffset, sampleCount: 1 };
    const sampleCount = Math.min(missing, Math.floor(paths / this.#pixels));
    return { pixelOffset, pixelCount: this.#pixels, sampleOffset, sampleCount };
  }
}

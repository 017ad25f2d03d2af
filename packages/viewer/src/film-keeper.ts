import type { FilmState, PathTracer } from '@glanz/renderer';

/** Milliseconds between two copies at least. */
const REST_MS = 3000;
/** Bytes of a film whose copying would hold up a frame. */
const MAX_BYTES = 134_217_728;
/** Bytes that a copied film takes for each of its pixels, besides its light groups; and for each of those. */
const [PIXEL_BYTES, GROUP_BYTES] = [32, 32];

/**
 * Keeps a copy of a film's samples in CPU memory, so that they outlive the GPU: at doubling numbers of samples, some
 * seconds apart, and when the image is done.
 */
export class FilmKeeper {
  readonly #now: () => number;
  #kept: FilmState | undefined;
  /** Counts images: a copy that comes when there is another one is not kept. */
  #image = 0;
  #saving = false;
  /** Whether the image got done while a copy was made: another one follows. */
  #doneMeanwhile = false;
  #refused = false;
  #last: number;

  /** @param now Milliseconds. */
  constructor(now: () => number = () => performance.now()) {
    this.#now = now;
    this.#last = now();
  }

  /** The samples that are kept of the image. */
  get kept(): FilmState | undefined {
    return this.#kept;
  }

  /** Drops the copy: the film shows another image from now on. */
  clear(): void {
    this.#image++;
    this.#kept = undefined;
    this.#refused = this.#doneMeanwhile = false;
    this.#last = this.#now();
  }

  /**
   * Copies the samples of a film if it is time to. Does not block.
   *
   * @param done Whether no more samples are to come.
   */
  offer(tracer: PathTracer, done: boolean): void {
    const { samples, width, height, lightGroups } = tracer;
    const known = this.#kept?.samples ?? 0;
    if (this.#saving) this.#doneMeanwhile = done;
    if (this.#saving || this.#refused || samples <= known) return;
    if (!done && (samples < 2 * known || this.#now() - this.#last < REST_MS)) return;
    if (width * height * (PIXEL_BYTES + GROUP_BYTES * Math.max(1, lightGroups.length)) > MAX_BYTES) return;
    void this.#save(tracer);
  }

  async #save(tracer: PathTracer): Promise<void> {
    const image = this.#image;
    this.#saving = true;
    try {
      const state = await tracer.saveFilm();
      if (image === this.#image) this.#kept = state;
    } catch {
      // A lost device, or no memory for a copy: the former copy serves, and this image is not asked for again.
      if (image === this.#image) this.#refused = true;
    } finally {
      this.#saving = false;
      this.#last = this.#now();
    }
    if (!this.#doneMeanwhile) return;
    this.#doneMeanwhile = false;
    this.offer(tracer, true);
  }
}

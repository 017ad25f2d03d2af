import { CostModel } from './cost-model';

/** A piece of work for one submission: whole samples of the whole image, or a band of one sample. */
export interface Batch {
  readonly pixelOffset: number;
  readonly pixelCount: number;
  readonly sampleOffset: number;
  readonly sampleCount: number;
}

export interface SchedulerOptions {
  /** Pixels of the image. */
  readonly pixels: number;
  /** Paths the buffers can hold. */
  readonly capacity: number;
  /** Milliseconds that one submission should take at most. */
  readonly budgetMs: number;
}

/** No submission is smaller than this many paths, or launch costs would dominate. */
const SMALLEST = 4096;

/** Budgets that a batch may take where that shares more of what every batch costs. */
const LONGEST = 3;

/**
 * Splits the work into submissions by measured time: grows up to fourfold while the budget allows, falls back to a
 * quarter after one that took too long. The image does not depend on the split.
 */
export class Scheduler {
  /** Pixels of the image, or of the part of it that is worked on. */
  readonly pixels: number;
  readonly #capacity: number;
  /** Milliseconds that one submission should take at most. */
  budget: number;
  #paths: number;
  readonly #cost = new CostModel();
  /** Whether nothing was learned from others before. */
  readonly #fresh: boolean;
  /** Whether batches are learned from: not the first of all, which has one-time costs of kernels and memory. */
  #begun: boolean;
  #sample: number;
  #pixel = 0;

  /**
   * @param paths Paths that the first batch may hold, where that was learned from others before.
   * @param samples Samples that the pixels have already.
   * @param pixel Pixels, from the first on, that have one sample more: the next batch is the rest of that sample.
   */
  constructor(options: SchedulerOptions, paths?: number, samples = 0, pixel = 0) {
    this.pixels = options.pixels;
    this.#sample = samples;
    this.#pixel = pixel;
    this.#capacity = options.capacity;
    this.budget = options.budgetMs;
    this.#fresh = paths === undefined;
    this.#begun = !this.#fresh;
    this.#paths = Math.min(paths ?? SMALLEST * 4, options.capacity);
  }

  /** Completed samples of every pixel. */
  get samples(): number {
    return this.#sample;
  }

  /** Paths the next batch may hold. */
  get paths(): number {
    return this.#paths;
  }

  /** Whether some pixels have a sample more than the others: the last batch was a band. */
  get partial(): boolean {
    return this.#pixel > 0;
  }

  /** Pixels that have a sample more than {@link samples}: those of the bands of a sample that is under way. */
  get pixel(): number {
    return this.#pixel;
  }

  /** A scheduler for other pixels, which have `samples` samples, that remembers the GPU's speed. */
  continued(pixels: number, samples: number): Scheduler {
    return new Scheduler({ pixels, capacity: this.#capacity, budgetMs: this.budget }, this.#paths, samples);
  }

  /**
   * The next piece up to `target` samples, or `undefined` when all have been given out.
   * @param room Paths that there is memory for at the moment.
   */
  next(target: number, room = Infinity): Batch | undefined {
    if (this.#sample >= target) return undefined;
    const paths = Math.min(this.#paths, Math.max(1, room));
    if (this.#pixel > 0 || paths < this.pixels) {
      const pixelOffset = this.#pixel;
      const rest = this.pixels - pixelOffset;
      // Bands of equal size: a sliver at the end would be launched for nothing.
      const bands = Math.ceil(rest / paths);
      const pixelCount = Math.ceil(rest / bands);
      const batch = { pixelOffset, pixelCount, sampleOffset: this.#sample, sampleCount: 1 };
      this.#pixel += pixelCount;
      if (this.#pixel >= this.pixels) {
        this.#pixel = 0;
        this.#sample++;
      }
      return batch;
    }
    const sampleCount = Math.min(Math.floor(paths / this.pixels), target - this.#sample);
    const batch = { pixelOffset: 0, pixelCount: this.pixels, sampleOffset: this.#sample, sampleCount };
    this.#sample += sampleCount;
    return batch;
  }

  /** Learns from the time a batch took on the GPU. */
  measured(batch: Batch, milliseconds: number): void {
    const paths = batch.pixelCount * batch.sampleCount;
    const cost = this.#cost;
    if (this.#begun) cost.measured(paths, milliseconds, batch.pixelCount === this.pixels);
    this.#begun = true;
    // What every batch costs, however small, must not take most of the time: long paths through glass leave the GPU
    // nearly idle at their end, and samples that are traced together share that.
    const budget = Math.max(this.budget, 3 * cost.fixed, Math.min(6 * cost.fixed, LONGEST * this.budget));
    if (milliseconds > budget * 1.5) {
      const factor = Math.max(0.25, (0.8 * budget) / milliseconds);
      this.#paths = Math.min(this.#capacity, Math.max(SMALLEST, Math.min(this.#paths, Math.floor(paths * factor))));
    } else if (milliseconds < budget * 0.7) {
      // By the speed of this batch, which may have been smaller than allowed.
      const fixed = Math.min(cost.fixed, 0.9 * milliseconds);
      const affordable = ((0.9 * budget - fixed) * paths) / Math.max(milliseconds - fixed, 1e-3);
      // Sizes that hardly differ do not tell what is the same for all.
      const possible = Math.max(affordable, this.#fresh && !cost.isFixedKnown ? 2 * paths : 0);
      // A band of sky is cheap, and the next one may cost what an earlier one did.
      const safe = cost.peak > 0 ? Math.max(0, 1.4 * budget - cost.fixed) / cost.peak : Infinity;
      const allowed = Math.floor(Math.min(possible, safe, 4 * this.#paths));
      this.#paths = Math.min(this.#capacity, Math.max(this.#paths, allowed));
    } else if (!cost.isFixedKnown) {
      // One larger batch tells how much of the time was not for its paths. Larger than this one: a preview of few pixels
      // has smaller batches than are allowed, however many there are.
      this.#paths = Math.min(this.#capacity, Math.max(this.#paths, 2 * paths));
    }
  }
}

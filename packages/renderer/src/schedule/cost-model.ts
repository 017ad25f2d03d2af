/** What is left of a high cost, with each measurement, in {@link CostModel.peak}: half after ten. */
const MEMORY = 0.93;
/** The same, with each measurement that covers all parts of the work. */
const MEMORY_OF_PARTS = 0.5;
/** Share of the latest measurement in {@link CostModel.mean}. */
const WEIGHT = 0.3;
/** How much two pieces of work must differ in size to show what is spent on each, whatever its size. */
const SPREAD = 1.5;
/** At most this share of a piece's time is held to be the same for all sizes. */
const MAX_FIXED = 0.9;

/**
 * Predicts the cost of work on the GPU from measured pieces of different sizes: `fixed + size × cost of a unit`. The
 * caller chooses the unit: paths of a batch, pixels × samples of a frame. Deterministic in its inputs.
 */
export class CostModel {
  #fixed: number | undefined;
  #mean: number | undefined;
  /** The piece that {@link peak} is about, and the share of its cost that is remembered. */
  #costly = { size: 1, milliseconds: 0, share: 0 };
  #last: { readonly size: number; readonly milliseconds: number } | undefined;

  /** Milliseconds that a piece takes besides what its units take; 0 until pieces of different sizes were measured. */
  get fixed(): number {
    return this.#fixed ?? 0;
  }

  /** Whether pieces of different sizes have been measured. */
  get isFixedKnown(): boolean {
    return this.#fixed !== undefined;
  }

  /** Milliseconds a unit: moving average, `undefined` before the first measurement. */
  get mean(): number | undefined {
    return this.#mean;
  }

  /** Milliseconds a unit: decaying maximum. Parts of an image differ in cost. */
  get peak(): number {
    const { size, milliseconds, share } = this.#costly;
    return (share * Math.max(0, milliseconds - this.fixed)) / size;
  }

  /**
   * Learns from a piece of `size` units, above 0, that took `milliseconds`.
   * @param whole Whether it covers all parts of the work: the peak of single parts is then forgotten sooner.
   */
  measured(size: number, milliseconds: number, whole = false): void {
    const last = this.#last;
    if (last && Math.max(size, last.size) > SPREAD * Math.min(size, last.size)) {
      const slope = Math.max(0, (milliseconds - last.milliseconds) / (size - last.size));
      const shortest = Math.min(milliseconds - slope * size, last.milliseconds - slope * last.size);
      const fixed = Math.max(0, Math.min(shortest, MAX_FIXED * milliseconds, MAX_FIXED * last.milliseconds));
      this.#fixed = 0.5 * ((this.#fixed ?? fixed) + fixed);
    }
    if (size !== last?.size) this.#last = { size, milliseconds };
    const unit = Math.max(0, milliseconds - this.fixed) / size;
    this.#mean = this.#mean === undefined ? unit : (1 - WEIGHT) * this.#mean + WEIGHT * unit;
    const memory = whole ? MEMORY_OF_PARTS : MEMORY;
    if (unit < memory * this.peak) this.#costly.share *= memory;
    else this.#costly = { size, milliseconds, share: 1 };
  }
}

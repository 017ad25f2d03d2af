/** Multiply-adds of the first submission: a fraction of a second on a CPU. */
const FIRST = 2e8;

/**
 * Decides how much work goes into one submission, so that each takes about the time that the caller allows, by the speed
 * of those before.
 */
export class Pace {
  /** Milliseconds that one submission should take at most. */
  readonly budget: number;
  #work = FIRST;

  constructor(budgetMs: number) {
    this.budget = budgetMs;
  }

  /** Multiply-adds for the next submission. */
  get work(): number {
    return this.budget === Infinity ? Infinity : this.#work;
  }

  /** Learns from a submission of `work` multiply-adds: grows at most fourfold, falls at once. */
  measured(work: number, milliseconds: number): void {
    const possible = (0.9 * this.budget * work) / Math.max(milliseconds, 0.01);
    // What was less than allowed tells little about the speed of more.
    if (possible > this.#work) this.#work = Math.min(possible, 4 * this.#work);
    else if (work >= 0.5 * this.#work || milliseconds > this.budget) this.#work = Math.max(possible, 1e6);
  }
}

/** Milliseconds between two returns to the event loop. */
const SLICE_MS = 12;

/**
 * Shaders are composed and weights packed on the calling thread, which has other things to do as well.
 *
 * @returns What returns to the event loop where a slice of time is over.
 */
export function pauses(): () => Promise<void> {
  let since = performance.now();
  return async () => {
    if (performance.now() - since < SLICE_MS) return;
    await new Promise((resolve) => setTimeout(resolve));
    since = performance.now();
  };
}

import { CostModel } from '@glanz/renderer';

/**
 * Image while the view or the scene moves.
 *
 * - `raw`: the film's samples as they are, in as many pixels as keep the frame rate.
 * - `filtered`: the same with the frames before it, reprojected, and filtered in space: nearly without noise, and
 *   reflections lag a little. When the view rests, the film begins with its own samples, as if nothing had moved, and
 *   takes over as its noise falls.
 * - `auto`: `filtered`, but `raw` on software adapters. Until the filter is loaded and compiled, with the first movement,
 *   and where there is no memory for it (300 bytes a pixel), frames are raw.
 */
export type PreviewMode = 'auto' | 'raw' | 'filtered';

/** How a preview is made: what share of the image's width and height, and how many samples. */
export interface PreviewPlan {
  /** Width and height are divided by it: 1, 1.5, 2, 3, 4, 6 or 8. */
  readonly divisor: number;
  /** Samples per pixel of a frame. */
  readonly samples: number;
}

/** Steps by which the preview shrinks. Areas about halve, so that sizes do not change for every breath of the clock. */
export const DIVISORS = [1, 1.5, 2, 3, 4, 6, 8] as const;

/** Coarser images are useless: below this, the frame rate drops before the resolution does. */
const COARSE = 4;
/** How much longer frames of coarse previews may take. */
const PATIENT = 2.5;
/** Maximum samples of a preview's frame. */
const MAX_SAMPLES = 8;
/** A step to a larger preview, or to more samples, is taken only where this share of the time suffices. */
const CAUTION = 0.9;
/** Frames that a size is kept before a larger one is tried. */
const PATIENCE = 6;

/**
 * Chooses the preview's resolution by the time that frames take, so that a view that moves keeps its rate. Grows
 * slowly, shrinks at once. No GPU: a pure function of what it is given.
 */
export class PreviewController {
  /** Milliseconds that a frame may take; two and a half times as many from a quarter of the width on down. */
  readonly budget: number;
  #divisor: number;
  readonly #cost = new CostModel();
  #calm = 0;

  constructor(budgetMs: number) {
    this.budget = budgetMs;
    this.#divisor = 4;
  }

  /** The next frame of an image of so many pixels. @param saving Whether frames take half of the time at most. */
  plan(pixels: number, saving = false): PreviewPlan {
    const { fixed, mean } = this.#cost;
    const budget = saving ? this.budget / 2 : this.budget;
    if (mean === undefined) return { divisor: this.#divisor, samples: 1 };
    const costOf = (divisor: number) => fixed + (mean * pixels) / divisor ** 2;
    const budgetOf = (divisor: number) => (divisor >= COARSE ? PATIENT * budget : budget);
    if (costOf(this.#divisor) > budgetOf(this.#divisor)) {
      this.#calm = 0;
      this.#divisor =
        DIVISORS.find((divisor) => costOf(divisor) <= budgetOf(divisor)) ?? (DIVISORS[DIVISORS.length - 1] as number);
    } else if (this.#divisor > 1) {
      const larger = DIVISORS.find((divisor) => costOf(divisor) <= CAUTION * budgetOf(divisor)) ?? this.#divisor;
      if (larger < this.#divisor && ++this.#calm >= PATIENCE) {
        this.#calm = 0;
        this.#divisor = larger;
      }
    }
    const spare = Math.floor((CAUTION * budget - fixed) / Math.max(1e-6, costOf(this.#divisor) - fixed));
    return { divisor: this.#divisor, samples: Math.max(1, Math.min(MAX_SAMPLES, spare)) };
  }

  /**
   * Learns from a frame: pixels × samples that it took, and the time. Several milliseconds of a clock's noise do no
   * harm.
   */
  measured(pixels: number, samples: number, milliseconds: number): void {
    this.#cost.measured(pixels * samples, milliseconds);
  }
}

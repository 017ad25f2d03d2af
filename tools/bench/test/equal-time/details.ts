import type { ContestantName } from '../../src/equal-time/contestants';
import type { Measurement, Point } from '../../src/equal-time/measure';
import type { EqualTimeDetails } from '../../src/equal-time/summary';

export const BUDGETS = [100, 1000];

/**
 * A measurement whose relMSE is `error` after a second of GPU time and falls as 1 / time, with a wall time of `wall` ×
 * GPU time.
 */
export function measurement(scene: string, contestant: ContestantName, error: number, wall = 1): Measurement {
  const points: Point[] = BUDGETS.map((budgetMs) => ({
    budgetMs,
    gpuMs: budgetMs,
    wallMs: wall * budgetMs,
    samples: budgetMs,
    relMse: (error * 1000) / budgetMs,
    relMseWithReference: (error * 1000) / budgetMs + 1e-9,
    flip: Math.sqrt(error) / 10,
    brightness: 1,
  }));
  return {
    scene,
    contestant,
    adapter: { name: 'test', software: true },
    setUpMs: 12,
    points: [points, points],
    noise: points.map(({ relMse }) => relMse / 2),
    notes: [],
  };
}

/**
 * Two scenes: one of the reference set where the peer errs 100 times as much, one product scene where it is 16 times as
 * noisy.
 */
export const DETAILS: EqualTimeDetails = {
  budgetsMs: BUDGETS,
  size: 512,
  runs: 2,
  scenes: [
    { name: 'box', title: 'a box', truth: 'references' },
    { name: 'product', title: 'a product', truth: 'own' },
  ],
  measurements: [
    measurement('box', 'glanz', 1e-4),
    measurement('box', 'three-gpu-pathtracer', 1e-2, 2),
    measurement('box', 'three-gpu-pathtracer (defaults)', 1e-3),
    measurement('product', 'glanz', 1e-3),
    measurement('product', 'three-gpu-pathtracer', 1.6e-2),
  ],
  crossChecks: [
    { scene: 'product', samples: 16384, checkSamples: 4096, ratio: 1.0001, ratio95: 0.0002, outside: 1, blocks: 256 },
  ],
};

import { relMse } from './compare';
import type { GroundTruth } from './catalogue';
import { renderGroundTruth } from './render';

/** An error that was measured at some number of samples. */
export interface ConvergencePoint {
  readonly samples: number;
  /** relMSE without that of the reference. */
  readonly error: number;
}

/**
 * Slope of a line through logarithms of errors over those of samples, by least squares. Without bias and with
 * independent samples it is −1; an error that does not go away lifts it.
 */
export function convergenceSlope(points: readonly ConvergencePoint[]): number {
  const logs = points.map(({ samples, error }) => [Math.log(samples), Math.log(error)] as const);
  const mean = (k: 0 | 1) => logs.reduce((sum, pair) => sum + pair[k], 0) / logs.length;
  const [x, y] = [mean(0), mean(1)];
  return (
    logs.reduce((sum, pair) => sum + (pair[0] - x) * (pair[1] - y), 0) /
    logs.reduce((sum, pair) => sum + (pair[0] - x) ** 2, 0)
  );
}

/** Errors of a scene at several numbers of samples, by the independent sampler, each over `runs` seeds of its own. */
export async function measureConvergence(
  device: GPUDevice,
  truth: GroundTruth,
  counts: readonly number[],
  runs: number,
): Promise<ConvergencePoint[]> {
  const reference = truth.image();
  const points: ConvergencePoint[] = [];
  let seed = 1;
  for (const samples of counts) {
    let sum = 0;
    for (let run = 0; run < runs; run++) {
      const { image } = await renderGroundTruth(device, truth, { samples, seed: seed++, sampler: 'independent' });
      sum += relMse(image, reference.mean, reference.stats.relmse_eps);
    }
    points.push({ samples, error: sum / runs - reference.stats.relmse_of_reference });
  }
  return points;
}

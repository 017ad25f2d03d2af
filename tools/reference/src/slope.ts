import { relMse } from './compare';
import type { GroundTruth } from './reference-set';
import { groundTruthOptions, renderImages } from './render';

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

/**
 * Errors of a scene at several numbers of samples, by the independent sampler, each the mean over `runs` seeds.
 *
 * @param counts Ascending. Those of a seed are read from one film as it grows: neighbours on the line share half of their
 * samples, which moves both the same way, so the slope is known as well as from films of their own, in half the time.
 */
export async function measureConvergence(
  device: GPUDevice,
  truth: GroundTruth,
  counts: readonly number[],
  runs: number,
): Promise<ConvergencePoint[]> {
  const reference = truth.image();
  const scene = await truth.scene();
  const sums = counts.map(() => 0);
  for (let seed = 1; seed <= runs; seed++) {
    const options = groundTruthOptions(truth, { seed, sampler: 'independent' });
    const images = await renderImages(device, scene, counts, options);
    images.forEach((image, i) => (sums[i]! += relMse(image, reference.mean, reference.stats.relmse_eps)));
  }
  return counts.map((samples, i) => ({ samples, error: sums[i]! / runs - reference.stats.relmse_of_reference }));
}

import type { ReferenceImage, Tolerance } from './reference-set';
import { ReferenceError } from './error';

/** One test of {@link compareImages}. */
export interface Check {
  readonly name: string;
  readonly value: number;
  /** Passed if `value` is at most this. */
  readonly limit: number;
  readonly passed: boolean;
}

/** The outcome of {@link compareImages}. */
export interface Comparison {
  readonly passed: boolean;
  readonly checks: readonly Check[];
  /** Mean over pixels of the squared error relative to the reference's brightness. */
  readonly relMse: number;
  /** relMSE × samples: what one sample per pixel leaves of error. Comparable between renderers. */
  readonly relMsePerSample: number;
  /** How many samples of the reference's renderer one sample of the candidate is worth. */
  readonly efficiency: number;
}

const LUMINANCE = [0.2126, 0.7152, 0.0722] as const;
/** Edge of the blocks whose means are compared, pixels. */
const BLOCK = 16;

/**
 * Mean over pixels of the squared error, each relative to the reference pixel's squared brightness plus `epsilon`,
 * which keeps dark pixels from ruling the sum.
 */
export function relMse(candidate: ArrayLike<number>, reference: ArrayLike<number>, epsilon: number): number {
  const pixels = reference.length / 3;
  let sum = 0;
  for (let i = 0; i < pixels; i++) {
    let error = 0;
    let power = 0;
    for (let c = 3 * i; c < 3 * i + 3; c++) {
      error += (candidate[c]! - reference[c]!) ** 2 / 3;
      power += reference[c]! ** 2 / 3;
    }
    sum += error / (power + epsilon);
  }
  return sum / pixels;
}

/**
 * Says whether a Monte-Carlo image agrees with a reference, given the noise that its number of samples explains and
 * the tolerance of the scene:
 *
 * - T1: the mean of each channel, within the tolerance or four standard errors.
 * - T2: the luminance of 16 × 16 blocks, within four standard errors plus the tolerance; at most 1.6 % of blocks
 *   outside.
 * - T3: the noise itself (relMSE), against `k` times that of the reference's renderer at as many samples.
 * - T4: pixels beyond six standard errors, at most the tolerated share.
 *
 * @param candidate RGB, stride 3, linear, top row first.
 * @param samples Samples per pixel behind `candidate`.
 * @param noise Standard error of the candidate's mean, as a share of that of independent samples: Sobol points that
 * pixels share leave less. 0..1, default 1. It counts for T1.
 * @throws {ReferenceError} `reference/size` when the images differ in size.
 */
export function compareImages(
  candidate: Float32Array,
  samples: number,
  reference: ReferenceImage,
  size: { readonly width: number; readonly height: number },
  tolerance: Tolerance,
  noise = 1,
): Comparison {
  const { mean, standardError, stats } = reference;
  if (candidate.length !== mean.length)
    throw new ReferenceError(
      'reference/size',
      `The image has ${candidate.length / 3} pixels, its reference ${mean.length / 3}.`,
    );
  const pixels = mean.length / 3;
  const checks: Check[] = [];
  const check = (name: string, value: number, limit: number) =>
    checks.push({ name, value, limit, passed: value <= limit });

  check(
    'finite values',
    candidate.reduce((count, value) => count + (Number.isFinite(value) ? 0 : 1), 0),
    0,
  );

  // The candidate's own noise is unknown: the reference's, scaled by samples, stands in.
  const ratio = stats.spp / samples;
  const variance = Float64Array.from(standardError, (se) => se * se * (1 + ratio));

  for (const [c, channel] of ['red', 'green', 'blue'].entries()) {
    let [sumCandidate, sumReference, sumVariance] = [0, 0, 0];
    for (let i = c; i < mean.length; i += 3) {
      sumCandidate += candidate[i]!;
      sumReference += mean[i]!;
      sumVariance += standardError[i]! ** 2 * (1 + ratio * noise * noise);
    }
    check(
      `T1 mean ${channel}`,
      Math.abs(sumCandidate - sumReference) / pixels,
      Math.max((tolerance.mean * sumReference) / pixels, (4 * Math.sqrt(sumVariance)) / pixels),
    );
  }

  const blocks: { difference: number; error: number; brightness: number }[] = [];
  for (let y0 = 0; y0 + BLOCK <= size.height; y0 += BLOCK) {
    for (let x0 = 0; x0 + BLOCK <= size.width; x0 += BLOCK) {
      let [difference, power, brightness] = [0, 0, 0];
      for (let y = y0; y < y0 + BLOCK; y++) {
        for (let x = x0; x < x0 + BLOCK; x++) {
          for (let c = 0; c < 3; c++) {
            const i = (y * size.width + x) * 3 + c;
            const weight = LUMINANCE[c]!;
            difference += weight * (candidate[i]! - mean[i]!);
            power += weight * weight * variance[i]!;
            brightness += weight * mean[i]!;
          }
        }
      }
      const n = BLOCK * BLOCK;
      blocks.push({ difference: difference / n, error: Math.sqrt(power) / n, brightness: brightness / n });
    }
  }
  const average = blocks.reduce((sum, block) => sum + block.brightness, 0) / blocks.length;
  const outside = blocks.filter(
    ({ difference, error, brightness }) =>
      Math.abs(difference) > 4 * error + tolerance.block * Math.max(brightness, 0.05 * average),
  );
  check('T2 blocks outside', outside.length / blocks.length, blocks.length >= 64 ? 0.016 : 0);

  const error = relMse(candidate, mean, stats.relmse_eps);
  check(
    'T3 relMSE',
    error,
    (tolerance.k * stats.relmse_1spp) / samples + 2 * stats.relmse_of_reference + tolerance.floor,
  );

  let outliers = 0;
  for (let i = 0; i < pixels; i++) {
    const out = [3 * i, 3 * i + 1, 3 * i + 2].some(
      (j) => Math.abs(candidate[j]! - mean[j]!) > 6 * Math.sqrt(variance[j]!) + 0.01 * mean[j]! + 1e-4,
    );
    if (out) outliers++;
  }
  check('T4 outlier pixels', outliers / pixels, tolerance.outlier);

  return {
    passed: checks.every(({ passed }) => passed),
    checks,
    relMse: error,
    relMsePerSample: error * samples,
    efficiency: stats.relmse_1spp / (error * samples),
  };
}

/** The failed checks in one line, for messages; empty when all passed. */
export function failures({ checks }: Comparison): string {
  return checks
    .filter(({ passed }) => !passed)
    .map(({ name, value, limit }) => `${name} ${value.toPrecision(4)} > ${limit.toPrecision(4)}`)
    .join('; ');
}

import type { Check } from '../compare';
import { ReferenceError } from '../error';
import type { Estimate } from './estimate';

/** Edge of the blocks whose means are compared, pixels. */
const BLOCK = 8;
/** Standard errors by which means may differ. */
const MEAN_LIMIT = 4;
/** Relative error of a sum of 32-bit floats: it counts where a block has no noise, such as one of nothing but sky. */
const ROUNDING = 1e-5;
/** Quantile of the normal distribution that one value in 10,000 exceeds. */
const RARE = 3.719;

/** What 9,999 in 10,000 values of χ² do not exceed (Wilson and Hilferty's approximation). */
const chiSquareLimit = (degrees: number): number => {
  const spread = 2 / (9 * degrees);
  return degrees * (1 - spread + RARE * Math.sqrt(spread)) ** 3;
};

/** The outcome of {@link compareEstimates}. */
export interface Agreement {
  readonly agrees: boolean;
  /**
   * Two for each channel: the distance of the images' means in standard errors of their difference, and χ² of the blocks'
   * means.
   */
  readonly checks: readonly Check[];
  /** For each channel, the mean of the first image over that of the second, less 1. */
  readonly difference: readonly number[];
  /** Its standard error. */
  readonly error: readonly number[];
}

/**
 * Says whether two images, each with its standard errors, show the same: the mean of each channel within four standard
 * errors of the difference, and the means of 8 × 8 blocks by χ², which 1 image in 10,000 fails by chance. Besides
 * there is one hundred-thousandth for rounding.
 *
 * @param a Pixels must be independent of each other, in both images.
 * @throws {ReferenceError} `reference/size` when an image does not have the size.
 */
export function compareEstimates(
  a: Estimate,
  b: Estimate,
  { width, height }: { readonly width: number; readonly height: number },
): Agreement {
  for (const { mean } of [a, b])
    if (mean.length !== 3 * width * height)
      throw new ReferenceError(
        'reference/size',
        `An image has ${mean.length / 3} pixels instead of ${width} × ${height}.`,
      );
  const checks: Check[] = [];
  const [differences, errors]: [number[], number[]] = [[], []];
  const check = (name: string, value: number, limit: number) =>
    // NaN does not pass.
    checks.push({ name, value, limit, passed: value <= limit });
  const columns = Math.ceil(width / BLOCK);
  for (const [k, channel] of ['red', 'green', 'blue'].entries()) {
    const blocks = Array.from({ length: columns * Math.ceil(height / BLOCK) }, () => ({
      difference: 0,
      variance: 0,
      brightness: 1e-9,
    }));
    let sum = 0;
    for (let i = 0; i < width * height; i++) {
      const at = 3 * i + k;
      const block = blocks[columns * Math.floor(i / width / BLOCK) + Math.floor((i % width) / BLOCK)]!;
      block.difference += a.mean[at]! - b.mean[at]!;
      block.variance += a.standardError[at]! ** 2 + b.standardError[at]! ** 2;
      block.brightness += b.mean[at]!;
      sum += b.mean[at]!;
    }
    const difference = blocks.reduce((total, block) => total + block.difference, 0);
    const error = Math.sqrt(blocks.reduce((total, { variance }) => total + variance, 0));
    differences.push(difference / sum);
    errors.push(error / sum);
    // Errors that are not known, infinite, make no agreement.
    check(`mean ${channel}, standard errors`, error < Infinity ? Math.abs(difference) / error : NaN, MEAN_LIMIT);
    const square = blocks.reduce(
      (total, block) => total + block.difference ** 2 / (block.variance + (ROUNDING * block.brightness) ** 2),
      0,
    );
    check(`blocks ${channel}, χ²`, square, chiSquareLimit(blocks.length));
  }
  return { agrees: checks.every(({ passed }) => passed), checks, difference: differences, error: errors };
}

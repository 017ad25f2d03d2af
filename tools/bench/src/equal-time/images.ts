import { toneMap } from '@glanz/tonemap';
import { flip } from '../flip/flip';

/** A reference image, RGB, stride 3, linear, top row first. */
export interface Reference {
  readonly width: number;
  readonly height: number;
  readonly mean: Float32Array;
  /** Standard error of each value of `mean`. */
  readonly standardError: Float32Array;
}

/** How far an image is from its reference, pixel by pixel. */
export interface PixelError {
  /**
   * As the ground truth defines it, less what the reference's own noise adds on average; about 0 or below where only
   * that is left.
   */
  readonly relMse: number;
  /** {@link relMse} with the reference's noise in it. */
  readonly relMseWithReference: number;
  /** Mean of the image over that of the reference, all channels together. */
  readonly brightness: number;
}

/** How far an image is from its reference, and how far one sees that it is. */
export interface ImageError extends PixelError {
  /** Mean ꟻLIP of the tone-mapped images, 0..1. */
  readonly flip: number;
}

/** Means of `factor` × `factor` pixels. */
export function shrink(image: Float32Array, width: number, height: number, factor: number): Float32Array {
  const [w, h] = [width / factor, height / factor];
  if (!Number.isInteger(w) || !Number.isInteger(h))
    throw new RangeError(`shrink: ${width} × ${height} pixels cannot be joined ${factor} × ${factor}`);
  const out = new Float32Array(3 * w * h);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const to = 3 * (Math.floor(y / factor) * w + Math.floor(x / factor));
      for (let c = 0; c < 3; c++) out[to + c]! += image[3 * (y * width + x) + c]! / (factor * factor);
    }
  }
  return out;
}

/**
 * Mean over pixels of `numerator` (mean of the channels) over the reference pixel's squared brightness plus 1 % of the
 * image's.
 */
function relative(numerator: (index: number) => number, reference: Float32Array): number {
  const pixels = reference.length / 3;
  const epsilon = (0.01 * reference.reduce((sum, value) => sum + value * value, 0)) / reference.length;
  let sum = 0;
  for (let i = 0; i < pixels; i++) {
    let error = 0,
      power = 0;
    for (let c = 3 * i; c < 3 * i + 3; c++) {
      error += numerator(c) / 3;
      power += reference[c]! ** 2 / 3;
    }
    sum += error / (power + epsilon);
  }
  return sum / pixels;
}

/**
 * Half the mean squared difference of two independent images of the same expectation, as relMSE: their noise,
 * whatever their bias.
 */
export function noiseOf(a: Float32Array, b: Float32Array, reference: Reference): number {
  return relative((i) => (a[i]! - b[i]!) ** 2 / 2, reference.mean);
}

/** sRGB codes 0..1 of a linear image by the neutral tone map. */
export function displayed(image: Float32Array): Float32Array {
  const out = new Float32Array(image.length);
  for (let i = 0; i < image.length; i += 3) out.set(toneMap([image[i]!, image[i + 1]!, image[i + 2]!]), i);
  return out;
}

/** ꟻLIP looks at images of at most this width: a pixel of a larger one is joined with its neighbours. */
const FLIP_WIDTH = 256;

function flipError(image: Float32Array, { mean, width, height }: Reference): number {
  const factor = Math.max(1, Math.floor(width / FLIP_WIDTH));
  const [a, b] = [mean, image].map((p) => displayed(factor === 1 ? p : shrink(p, width, height, factor)));
  return flip(a!, b!, width / factor, height / factor).mean;
}

/** Compares an image with a reference of the same size, pixel by pixel. */
export function pixelError(image: Float32Array, { mean, standardError }: Reference): PixelError {
  const squared = (i: number) => (image[i]! - mean[i]!) ** 2;
  const total = (values: Float32Array) => values.reduce((sum, value) => sum + value, 0);
  return {
    relMse: relative((i) => squared(i) - standardError[i]! ** 2, mean),
    relMseWithReference: relative(squared, mean),
    brightness: total(image) / total(mean),
  };
}

/** Compares an image with a reference of the same size. */
export const imageError = (image: Float32Array, reference: Reference): ImageError => ({
  ...pixelError(image, reference),
  flip: flipError(image, reference),
});

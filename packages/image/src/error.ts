import { GlanzError } from '@glanz/wgsl/error';

/**
 * Thrown when bytes are not a valid image of their format, or an image cannot be written. `location.byteOffset` is
 * set where it is known. Codes:
 *
 * - `image/format`: the bytes are not that kind of file. Pass an image of a format that the function reads.
 * - `image/header`: the header is malformed. Export the file again.
 * - `image/size`: the size is impossible, more than `maxPixels`, or not that of the values. Raise `maxPixels` where
 *   it is intended.
 * - `image/truncated`: the file ends too early. Load it again.
 * - `image/corrupt`: the compressed data contradicts itself. Load or export the file again.
 * - `image/unsupported`: the file is valid, but uses something that is not read. Save it as a flat image with ZIP
 *   compression.
 * - `image/channels`: an environment has no R, G and B, or channels to write have invalid names. Rename them.
 */
export class ImageError extends GlanzError {}

/** A fault that a decoder worked around. */
export interface ImageWarning {
  /** Stable, machine-readable: `image/<what>`. */
  readonly code: string;
  /** One line for people. */
  readonly message: string;
}

/** Limits that a decoder checks before it allocates memory. */
export interface DecodeOptions {
  /** Maximum number of pixels of an image; default 2^26, which is 8192 × 8192. */
  readonly maxPixels?: number;
}

/** Default of {@link DecodeOptions.maxPixels}. */
export const MAX_PIXELS = 2 ** 26;

/**
 * Zero-filled memory for an image.
 * @param numbers A pixel.
 * @throws {ImageError} `image/size` if there is not enough memory.
 */
export function allocateFloats(
  what: string,
  width: number,
  height: number,
  numbers: number,
): Float32Array<ArrayBuffer> {
  try {
    return new Float32Array(width * height * numbers);
  } catch (cause) {
    throw new ImageError(
      'image/size',
      `${what}: there is not enough memory for ${width}×${height} pixels; scale the image down.`,
      { cause },
    );
  }
}

/** @throws {ImageError} `image/size` unless both sides are positive integers and their product is within the limit. */
export function checkSize(what: string, width: number, height: number, maxPixels: number = MAX_PIXELS): void {
  if (!Number.isInteger(width) || !Number.isInteger(height) || width < 1 || height < 1) {
    throw new ImageError(
      'image/size',
      `${what}: an image of ${width}×${height} pixels is not possible; both sides must be positive integers.`,
    );
  }
  if (width * height > maxPixels) {
    throw new ImageError(
      'image/size',
      `${what}: ${width}×${height} pixels are more than the limit of ${maxPixels}; raise maxPixels if that is meant.`,
    );
  }
}

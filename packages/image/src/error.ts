import { GlanzError } from '@glanz/wgsl/error';

/**
 * Thrown when bytes are not a valid image of their format, or an image cannot be written. `location.byteOffset` is set
 * where it is known. Codes: `image/format` (not that kind of file), `image/header`, `image/size`, `image/truncated`,
 * `image/corrupt`, `image/unsupported` (valid, but not something this package reads), `image/channels`.
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

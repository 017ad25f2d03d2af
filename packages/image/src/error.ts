import { GlanzError } from '@glanz/wgsl/error';

/**
 * Thrown when bytes are not the picture they claim to be, or a picture cannot be written. `location.byteOffset` is set
 * where it is known. Codes: `image/format` (not that kind of file), `image/header`, `image/size`, `image/truncated`,
 * `image/corrupt`, `image/unsupported` (valid, but not something this package reads), `image/channels`.
 */
export class ImageError extends GlanzError {}

/** Something a decoder worked around. */
export interface ImageWarning {
  /** Stable, machine-readable: `image/<what>`. */
  readonly code: string;
  /** One line for people. */
  readonly message: string;
}

/** Limits a decoder keeps to before it allocates anything. */
export interface DecodeOptions {
  /** The most pixels a picture may have; default 2^26, which is 8192 × 8192. */
  readonly maxPixels?: number;
}

/** Default of {@link DecodeOptions.maxPixels}. */
export const MAX_PIXELS = 2 ** 26;

/**
 * Memory for a picture, zeros.
 * @param numbers A pixel.
 * @throws {ImageError} `image/size` if there is not as much.
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
      `${what}: there is no memory for ${width}×${height} pixels; scale the picture down.`,
      { cause },
    );
  }
}

/** @throws {ImageError} `image/size` unless both sides are positive integers and their product is within the limit. */
export function checkSize(what: string, width: number, height: number, maxPixels: number = MAX_PIXELS): void {
  if (!Number.isInteger(width) || !Number.isInteger(height) || width < 1 || height < 1) {
    throw new ImageError('image/size', `${what}: a picture of ${width}×${height} pixels is not possible.`);
  }
  if (width * height > maxPixels) {
    throw new ImageError(
      'image/size',
      `${what}: ${width}×${height} pixels are more than the limit of ${maxPixels}; raise maxPixels if that is meant.`,
    );
  }
}

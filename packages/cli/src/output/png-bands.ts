import { promisify } from 'node:util';
import { constants, deflateRaw } from 'node:zlib';
import { encodePngBand, type PngBand } from '@glanz/image/png';
import { toneMapPixels, type ToneMapPixelsOptions } from '@glanz/tonemap';

/**
 * Runs of equal bytes alone: longer matches are rare in filtered rows of rendered images. Measured on such images, files
 * are 4 % larger than by level 6 without noise, 9 % smaller with it, and made in a tenth of the time.
 */
const STRATEGY = { level: 6, strategy: constants.Z_RLE, finishFlush: constants.Z_SYNC_FLUSH };

/** For the bands of `@glanz/image/png`, on the threads of Node. */
export const deflateBand = (bytes: Uint8Array): Promise<Uint8Array> =>
  promisify<Uint8Array, object, Uint8Array>(deflateRaw)(bytes, STRATEGY);

/** Rows of an image without transparency, on their way to a PNG file. */
export interface LinearBand {
  /** Linear RGBA, stride 4, of the row above the band, if it has one, and of its rows. */
  readonly beauty: Float32Array<ArrayBuffer>;
  /** Pixels. */
  readonly width: number;
  readonly above: boolean;
  readonly toneMap: ToneMapPixelsOptions & { readonly output: 'uint8' | 'uint16' };
}

/** Tone-mapped, filtered and compressed: what a thread does for an image. */
export function bandOf({ beauty, width, above, toneMap }: LinearBand): Promise<PngBand> {
  const data = toneMapPixels(beauty, width, beauty.length / 4 / width, toneMap);
  return encodePngBand({ width, data, above, opaque: true }, deflateBand);
}

import {
  encodePng,
  encodePngAsync,
  joinPngBands,
  pngBandRows,
  type PngBand,
  type PngHeader,
  type PngSource,
} from '@glanz/image/png';
import { toneMapPixels, type ToneMap } from '@glanz/tonemap';
import { denoisedText, type RenderedImage } from './image';
import { deflateBand, type LinearBand } from './png-bands';
import { bandsOnThreads } from './png-threads';

/** The way to the screen. */
export interface DisplayOptions {
  readonly toneMap: ToneMap;
  /** Stops. */
  readonly exposure: number;
  readonly transparent: boolean;
}

/**
 * Pixels from which on an image is compressed by Node's zlib, on its threads: ten times as fast. Smaller ones are
 * compressed by `fflate`, whose bytes are the same with every version of Node.
 */
const THREAD_PIXELS = 2 ** 20;

/** Pixels from which on threads do more than they cost. */
const BAND_PIXELS = 2 ** 22;

/** The bands of an image without transparency, by threads. */
const bandsOf = (
  linear: Float32Array,
  header: PngHeader,
  toneMap: LinearBand['toneMap'],
  script: string | undefined,
): Promise<readonly PngBand[] | undefined> => {
  const { width, height } = header;
  const rows = pngBandRows(header);
  return bandsOnThreads(
    Math.ceil(height / rows),
    (index) => {
      const first = index * rows;
      const above = first > 0;
      const beauty = linear.slice(4 * width * (above ? first - 1 : 0), 4 * width * (first + rows));
      return { beauty: beauty as Float32Array<ArrayBuffer>, width, above, toneMap };
    },
    script,
  );
};

/**
 * The image tone-mapped, sRGB-encoded and packed as PNG.
 *
 * @param script Of the threads that make large images. Default: that of the package.
 */
export async function pngFile(
  image: RenderedImage,
  bits: 8 | 16,
  { toneMap, exposure, transparent }: DisplayOptions,
  script?: string,
): Promise<Uint8Array> {
  const { width, height, beauty, denoised } = image;
  const linear = denoised?.data ?? beauty;
  const options = {
    toneMap,
    exposure,
    alpha: transparent ? 'straight' : 'opaque',
    output: bits === 16 ? 'uint16' : 'uint8',
  } as const;
  const text = { Software: image.software, ...denoisedText(denoised, 'Denoised') };
  const header = { width, height, bits, opaque: true, text };
  const bands =
    transparent || width * height < BAND_PIXELS ? undefined : await bandsOf(linear, header, options, script);
  if (bands) return joinPngBands(header, bands);
  const source: PngSource = { width, height, data: toneMapPixels(linear, width, height, options), text };
  return width * height < THREAD_PIXELS ? encodePng(source) : encodePngAsync(source, deflateBand);
}

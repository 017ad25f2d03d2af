import { zlibSync } from 'fflate';
import { filterRows } from './png-filter';
import { headerOf, pngOf, rowsOf, type PngSource } from './png-file';

export {
  encodePngAsync,
  encodePngBand,
  joinPngBands,
  pngBandRows,
  type PngBand,
  type PngBandSource,
  type PngDeflate,
} from './png-bands';
export type { PngHeader, PngSource } from './png-file';

/**
 * Encodes sRGB codes as PNG, 8 or 16 bits per channel, with an sRGB chunk. An image that is opaque everywhere is
 * written without its alpha channel.
 *
 * @throws {ImageError} `image/size` if the array does not hold width × height RGBA pixels.
 */
export function encodePng(source: PngSource): Uint8Array<ArrayBuffer> {
  const { width, height, data, text = {}, level = 6 } = source;
  const header = headerOf(width, height, data);
  const filtered = filterRows(rowsOf(data, header), 0, height);
  return pngOf({ ...header, text }, [zlibSync(filtered, { level: level as 6 })]);
}

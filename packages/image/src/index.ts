export { ImageError, MAX_PIXELS, type DecodeOptions, type ImageWarning } from './error';
export { decodeHdr, type HdrImage } from './hdr-decode';
export { encodeHdr, type HdrSource } from './hdr-encode';
export {
  encodePng,
  encodePngAsync,
  encodePngBand,
  joinPngBands,
  pngBandRows,
  type PngBand,
  type PngBandSource,
  type PngDeflate,
  type PngHeader,
  type PngSource,
} from './png';
export { encodeExr, type ExrLayer, type ExrSource } from './exr-encode';
export type { ExrType } from './exr-block';
export { decodeExr, type ExrChannel, type ExrImage } from './exr-decode';
export { decodeEnvironment } from './environment';
export { fromHalf, HALF_MAX, toHalf } from './half';
export { applyGainMap, findGainMap, type GainMap, type GainMapPixels } from './gain-map';

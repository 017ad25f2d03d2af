import { encodePng } from '@glanz/image/png';
import { toneMapPixels, type ToneMap } from '@glanz/tonemap';
import { denoisedText, type RenderedImage } from './image';

/** The way to the screen. */
export interface DisplayOptions {
  readonly toneMap: ToneMap;
  /** Stops. */
  readonly exposure: number;
  readonly transparent: boolean;
}

/** The image tone-mapped, sRGB-encoded and packed as PNG. */
export function pngFile(
  image: RenderedImage,
  bits: 8 | 16,
  { toneMap, exposure, transparent }: DisplayOptions,
): Uint8Array {
  const { width, height, beauty, denoised } = image;
  const data = toneMapPixels(denoised?.data ?? beauty, width, height, {
    toneMap,
    exposure,
    alpha: transparent ? 'straight' : 'opaque',
    output: bits === 16 ? 'uint16' : 'uint8',
  });
  return encodePng({ width, height, data, text: { Software: image.software, ...denoisedText(denoised, 'Denoised') } });
}

import { DENOISE_BLACK, DENOISE_EXPOSURE_BLOCK, DENOISE_KEY, DENOISE_LUMINANCE } from '../kernels/constants.wesl';
import { clean } from './transfer';

/**
 * The factor by which an HDR image is multiplied before it is encoded: 0.18 over the geometric mean of the luminance of
 * its blocks of about 16 × 16 pixels; 1 for a black image.
 *
 * @param color Row by row, `stride` floats a pixel.
 */
export function automaticScale(color: ArrayLike<number>, width: number, height: number, stride: number): number {
  const rows = Math.ceil(height / DENOISE_EXPOSURE_BLOCK);
  const columns = Math.ceil(width / DENOISE_EXPOSURE_BLOCK);
  const edge = (i: number, size: number, count: number) => Math.floor((i * size) / count);
  let sum = 0;
  let counted = 0;
  for (let i = 0; i < rows; i++)
    for (let j = 0; j < columns; j++) {
      let luminance = 0;
      let pixels = 0;
      for (let y = edge(i, height, rows); y < edge(i + 1, height, rows); y++)
        for (let x = edge(j, width, columns); x < edge(j + 1, width, columns); x++) {
          for (let c = 0; c < 3; c++)
            luminance += DENOISE_LUMINANCE[c]! * clean(color[(y * width + x) * stride + c]!, 0, 3.4028234663852886e38);
          pixels++;
        }
      const mean = luminance / pixels;
      if (!(mean > DENOISE_BLACK)) continue;
      sum += Math.log2(mean);
      counted++;
    }
  return counted === 0 ? 1 : DENOISE_KEY / 2 ** (sum / counted);
}

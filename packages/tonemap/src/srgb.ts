import type { WgslModule } from '@glanz/wgsl/module';
import srgb from './srgb.wesl';

/**
 * WGSL `fn tonemap_srgb_encode(linear: vec3f) -> vec3f`: linear 0..1 (clamped) to the sRGB code 0..1 (IEC 61966-2-1).
 */
export const tonemapSrgb: WgslModule = srgb;

/** Linear 0..1 to the sRGB code 0..1 (IEC 61966-2-1); clamps, and NaN gives 0. */
export function srgbEncode(linear: number): number {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 1;
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
}

/** The sRGB code 0..1 to linear 0..1; clamps, and NaN gives 0. */
export function srgbDecode(code: number): number {
  if (!(code > 0)) return 0;
  if (code >= 1) return 1;
  return code <= 0.04045 ? code / 12.92 : ((code + 0.055) / 1.055) ** 2.4;
}

const CELLS = 4096;

/**
 * A function that gives `Math.floor(255 * srgbEncode(linear) + 0.5)`, without its power: the table holds, for each code,
 * the first number that has it, found by bisection, and for each cell of 0..1 the code at its beginning.
 */
export function srgbByteEncoder(): (linear: number) => number {
  const code = (linear: number) => Math.floor(255 * srgbEncode(linear) + 0.5);
  const first = new Float64Array(257).fill(Infinity);
  for (let k = 1; k < 256; k++) {
    let [low, high] = [0, 1];
    for (let middle = 0.5; middle > low && middle < high; middle = (low + high) / 2)
      if (code(middle) < k) low = middle;
      else high = middle;
    first[k] = high;
  }
  const cells = Uint8Array.from({ length: CELLS }, (_, i) => code(i / CELLS));
  return (linear) => {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    let k = cells[Math.floor(linear * CELLS)] as number;
    while (linear >= (first[k + 1] as number)) k++;
    return k;
  };
}

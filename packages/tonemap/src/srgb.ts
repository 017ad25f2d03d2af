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

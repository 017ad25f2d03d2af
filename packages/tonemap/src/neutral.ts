import { wgslModule } from '@glanz/wgsl/module';
import { finiteNumber, tonemapFinite } from './finite';
import type { Rgb } from './names';

/**
 * Reflectance at normal incidence of IOR 1.5: what a white furnace adds to a base colour, and the curve's toe takes
 * away.
 */
const F90 = 0.04;
/** K_s of the specification: where the highlights start to be compressed. */
const START = 0.8 - F90;
/** K_d: how fast highlights lose their colour. */
const DESATURATION = 0.15;

/**
 * WGSL `fn tonemap_neutral(linear: vec3f) -> vec3f`: Khronos PBR Neutral, after the specification text
 * (github.com/KhronosGroup/ToneMapping, PBR_Neutral). Base colours under grey light are preserved: with
 * every component at least 0.08 the curve takes 0.04 off, up to a peak of 0.76; above it compresses towards white.
 */
export const tonemapNeutral = wgslModule(
  'tonemap/neutral',
  /* wgsl */ `fn tonemap_neutral(linear: vec3f) -> vec3f {
  let c = tonemap_finite(linear);
  let x = min(c.r, min(c.g, c.b));
  let base = c - select(${F90}, x - x * x * ${1 / (4 * F90)}, x <= ${2 * F90});
  let peak = max(base.r, max(base.g, base.b));
  if (peak <= ${START}) { return base; }
  let compressed = 1.0 - ${(1 - START) ** 2} / (peak + ${1 - 2 * START});
  let keep = 1.0 / (${DESATURATION} * (peak - compressed) + 1.0);
  return mix(vec3f(compressed), base * (compressed / peak), keep);
}`,
  [tonemapFinite],
);

/** CPU twin of {@link tonemapNeutral}. @param out Becomes the result: images have tens of millions of pixels. */
export function neutralToneMap(rgb: Rgb, out: [number, number, number] = [0, 0, 0]): [number, number, number] {
  for (let k = 0; k < 3; k++) out[k] = finiteNumber(rgb[k] as number);
  const x = Math.min(out[0], out[1], out[2]);
  const offset = x <= 2 * F90 ? x - (x * x) / (4 * F90) : F90;
  const peak = Math.max(out[0], out[1], out[2]) - offset;
  const compressed = 1 - (1 - START) ** 2 / (peak + 1 - 2 * START);
  const keep = 1 / (DESATURATION * (peak - compressed) + 1);
  // Not a function of a component, which would be a new one for each pixel.
  for (let k = 0; k < 3; k++) {
    const v = (out[k] as number) - offset;
    out[k] = peak <= START ? v : compressed + (v / peak - 1) * compressed * keep;
  }
  return out;
}

import { wgslModule } from '@glanz/wgsl/module';
import { finite, mapRgb, tonemapFinite } from './finite';
import type { Rgb } from './names';

/** Luminance that {@link tonemapReinhard} maps to exactly 1: two stops above white. */
export const REINHARD_WHITE = 4;

/**
 * WGSL `fn tonemap_reinhard(linear: vec3f) -> vec3f`: the extended curve of Reinhard, Stark, Shirley and Ferwerda,
 * "Photographic Tone Reproduction for Digital Images" (SIGGRAPH 2002), equation 4, on Rec.709 luminance:
 * L' = L (1 + L/w²) / (1 + L) with w = {@link REINHARD_WHITE}. Hue is kept; components beyond 1 are clipped.
 */
export const tonemapReinhard = wgslModule(
  'tonemap/reinhard',
  /* wgsl */ `fn tonemap_reinhard(linear: vec3f) -> vec3f {
  let c = tonemap_finite(linear);
  let l = dot(c, vec3f(0.2126, 0.7152, 0.0722));
  return min(c * ((1.0 + l * ${1 / REINHARD_WHITE ** 2}) / (1.0 + l)), vec3f(1.0));
}`,
  [tonemapFinite],
);

/** CPU twin of {@link tonemapReinhard}. */
export function reinhardToneMap(rgb: Rgb): [number, number, number] {
  const c = finite(rgb);
  const l = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  const scale = (1 + l / REINHARD_WHITE ** 2) / (1 + l);
  return mapRgb(c, (v) => Math.min(v * scale, 1));
}

import { wgslModule } from '@glanz/wgsl/module';
import { finite, mapRgb, saturate, tonemapFinite } from './finite';
import type { Rgb } from './names';

/** WGSL `fn tonemap_linear(linear: vec3f) -> vec3f`: no curve at all, components clipped to 0..1. */
export const tonemapLinear = wgslModule(
  'tonemap/linear',
  /* wgsl */ `fn tonemap_linear(linear: vec3f) -> vec3f {
  return min(tonemap_finite(linear), vec3f(1.0));
}`,
  [tonemapFinite],
);

/** CPU twin of {@link tonemapLinear}. */
export function linearToneMap(rgb: Rgb): [number, number, number] {
  return mapRgb(finite(rgb), saturate);
}

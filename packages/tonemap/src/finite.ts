import type { WgslModule } from '@glanz/wgsl/module';
import { TONEMAP_MAX } from './constants.wesl';
import finiteModule from './finite.wesl';
import type { Rgb } from './names';

export { TONEMAP_MAX };

/**
 * WGSL `fn tonemap_finite(v: vec3f) -> vec3f`: NaN and negative components to 0, +∞ and anything above
 * {@link TONEMAP_MAX} to it. NaN is detected by its bits: WGSL lets compilers assume that it never occurs, so `v != v`
 * and `max(v, 0)` differ between implementations.
 */
export const tonemapFinite: WgslModule = finiteModule;

/** A function of one number for each component. */
export function mapRgb(rgb: Rgb, f: (v: number) => number): [number, number, number] {
  // Not `rgb.map`, which takes three times as long for an image.
  return [f(rgb[0]), f(rgb[1]), f(rgb[2])];
}

/** {@link finite} of one component. */
export const finiteNumber = (v: number) => (v > 0 ? Math.min(v, TONEMAP_MAX) : 0);

/** CPU twin of {@link tonemapFinite}. */
export function finite(rgb: Rgb): [number, number, number] {
  return mapRgb(rgb, finiteNumber);
}

/** To 0..1. */
export function saturate(v: number): number {
  return Math.min(Math.max(v, 0), 1);
}

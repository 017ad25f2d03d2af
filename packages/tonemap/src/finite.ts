import { wgslModule } from '@glanz/wgsl/module';
import type { Rgb } from './names';

/**
 * The brightest value a view transform computes with: 2^20, twenty stops above white. Everything brighter is white in
 * all of them, and squares of it stay far from overflow in 32-bit floats.
 */
export const TONEMAP_MAX = 1048576;

/**
 * WGSL `fn tonemap_finite(v: vec3f) -> vec3f`: NaN and negative components to 0, +∞ and anything above
 * {@link TONEMAP_MAX} to it. NaN is detected by its bits: WGSL lets compilers assume that it never occurs, so `v != v`
 * and `max(v, 0)` differ between implementations.
 */
export const tonemapFinite = wgslModule(
  'tonemap/finite',
  /* wgsl */ `fn tonemap_finite(v: vec3f) -> vec3f {
  let bits = bitcast<vec3u>(v);
  let magnitude = bits & vec3u(0x7fffffffu);
  let zero = (magnitude > vec3u(0x7f800000u)) | (bits > vec3u(0x7fffffffu));
  let big = magnitude > vec3u(${(127 + 20) * 2 ** 23}u);
  return select(select(v, vec3f(${TONEMAP_MAX}.0), big), vec3f(0.0), zero);
}`,
);

/** A function of one number for each component. */
export function mapRgb(rgb: Rgb, f: (v: number) => number): [number, number, number] {
  return rgb.map(f) as [number, number, number];
}

/** CPU twin of {@link tonemapFinite}. */
export function finite(rgb: Rgb): [number, number, number] {
  return mapRgb(rgb, (v) => (v > 0 ? Math.min(v, TONEMAP_MAX) : 0));
}

/** To 0..1. */
export function saturate(v: number): number {
  return Math.min(Math.max(v, 0), 1);
}

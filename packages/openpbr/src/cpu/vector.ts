import type { OpenPbrVector } from '../parameters/index';

export const dot = (a: OpenPbrVector, b: OpenPbrVector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

export function normalize(a: OpenPbrVector): OpenPbrVector {
  const scale = 1 / Math.hypot(a[0], a[1], a[2]);
  return [a[0] * scale, a[1] * scale, a[2] * scale];
}

export const clamp = (value: number, min: number, max: number): number => Math.min(Math.max(value, min), max);

import type { OpenPbrColor, OpenPbrVector } from '../parameters/index';

export const dot = (a: OpenPbrVector, b: OpenPbrVector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Length of a vector. Far from overflow, so not `Math.hypot`, which is ten times as slow. */
export const length2 = (x: number, y: number): number => Math.sqrt(x * x + y * y);
export const length3 = (x: number, y: number, z: number): number => Math.sqrt(x * x + y * y + z * z);

export function normalize(a: OpenPbrVector): OpenPbrVector {
  const scale = 1 / length3(a[0], a[1], a[2]);
  return [a[0] * scale, a[1] * scale, a[2] * scale];
}

export const clamp = (value: number, min: number, max: number): number => Math.min(Math.max(value, min), max);

/** A color of what a function gives for each channel. */
export const rgb = (channel: (i: 0 | 1 | 2) => number): OpenPbrColor => [channel(0), channel(1), channel(2)];

/** Three of anything, one for each channel. */
export const rgbOf = <T>(channel: (i: 0 | 1 | 2) => T): readonly [T, T, T] => [channel(0), channel(1), channel(2)];

/** Sum of the channels. */
export const sum = (color: OpenPbrColor): number => color[0] + color[1] + color[2];

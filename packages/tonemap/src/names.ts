import { GlanzError } from '@glanz/wgsl/error';

/** The view transforms of this package, the default first. */
export const TONE_MAPS = ['neutral', 'aces', 'agx', 'reinhard', 'linear'] as const;

/** Name of a view transform. */
export type ToneMap = (typeof TONE_MAPS)[number];

/** Linear Rec.709, three numbers. */
export type Rgb = readonly [number, number, number];

/**
 * Thrown on wrong arguments, and where the GPU refuses a shader. Codes: `tonemap/unknown`, `tonemap/size`,
 * `tonemap/exposure`, `tonemap/pipeline`, `tonemap/destroyed`, `tonemap/color`.
 */
export class ToneMapError extends GlanzError {}

/** Whether `name` is one of {@link TONE_MAPS}. */
export function isToneMap(name: string): name is ToneMap {
  return (TONE_MAPS as readonly string[]).includes(name);
}

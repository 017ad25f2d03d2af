import { GlanzError } from '@glanz/wgsl/error';

/** The view transforms of this package, the default first. */
export const TONE_MAPS = ['neutral', 'aces', 'agx', 'reinhard', 'linear'] as const;

/** Name of a view transform. */
export type ToneMap = (typeof TONE_MAPS)[number];

/** Linear Rec.709, three numbers. */
export type Rgb = readonly [number, number, number];

/**
 * Thrown on wrong arguments, and where the GPU refuses a shader. Codes:
 *
 * - `tonemap/unknown`: there is no tone map of this name. Choose one of {@link TONE_MAPS}.
 * - `tonemap/size`: the image has another size than its buffer. Pass four floats for each pixel.
 * - `tonemap/exposure`: an exposure or a setting of a camera is out of its range. Pass a number in the range of the
 *   message.
 * - `tonemap/pipeline`: the driver does not compile the shader. Use another tone map, or update the driver.
 * - `tonemap/destroyed`: the pass was used after `destroy()`. Create another one.
 * - `tonemap/color`: a text is not an opaque CSS colour. Use a name, `#rrggbb`, `rgb()` or `hsl()`.
 */
export class ToneMapError extends GlanzError {}

/** Whether `name` is one of {@link TONE_MAPS}. */
export function isToneMap(name: string): name is ToneMap {
  return (TONE_MAPS as readonly string[]).includes(name);
}

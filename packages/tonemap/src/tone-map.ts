import { mapRgb } from './finite';
import { ToneMapError, type Rgb, type ToneMap } from './names';
import { toneMapOperator } from './operators';
import { srgbByteEncoder, srgbEncode } from './srgb';

/** How to convert a linear, scene-referred colour for a display. */
export interface ToneMapOptions {
  /** Default `neutral`. */
  readonly toneMap?: ToneMap;
  /** Exposure in stops (EV), -64..64: the colour is multiplied by 2^exposure first. Default 0. */
  readonly exposure?: number;
}

/** Stops in either direction; beyond, products leave the range of single precision. */
const MAX_STOPS = 64;

/**
 * Validates a tone map and an exposure. Absent values are not checked.
 *
 * @throws {ToneMapError} `tonemap/unknown` for an unknown tone map; `tonemap/exposure` for an exposure that is not
 * a number from -64 to 64.
 */
export function checkToneMapOptions({ toneMap: name, exposure }: ToneMapOptions): void {
  if (name !== undefined) toneMapOperator(name);
  if (exposure !== undefined && !(typeof exposure === 'number' && Math.abs(exposure) <= MAX_STOPS)) {
    throw new ToneMapError(
      'tonemap/exposure',
      `The exposure is ${String(exposure)}; it must be a number of stops from -${MAX_STOPS} to ${MAX_STOPS}.`,
    );
  }
}

/** Options for {@link toneMapPixels}. */
export interface ToneMapPixelsOptions extends ToneMapOptions {
  /** `uint8` (default): codes 0..255; `uint16`: 0..65535; `float`: 0..1. */
  readonly output?: 'uint8' | 'uint16' | 'float';
  /**
   * `straight` (default): RGB is divided by alpha before the curve and alpha is unchanged, as PNG requires.
   * `opaque`: alpha is ignored and written as 1.
   */
  readonly alpha?: 'straight' | 'opaque';
}

interface Outputs {
  uint8: Uint8ClampedArray<ArrayBuffer>;
  uint16: Uint16Array<ArrayBuffer>;
  float: Float32Array<ArrayBuffer>;
}

/**
 * Linear, scene-referred colour to the sRGB codes of a display.
 *
 * @param rgb Linear Rec.709. NaN and negative components count as 0, +∞ as very bright.
 * @returns Three codes in 0..1, finite for any input.
 * @throws {ToneMapError} `tonemap/unknown`, `tonemap/exposure`
 * @example
 * toneMap([4, 2, 1], { toneMap: 'agx', exposure: -1 });
 */
export function toneMap(rgb: Rgb, options: ToneMapOptions = {}): [number, number, number] {
  checkToneMapOptions(options);
  const scale = 2 ** (options.exposure ?? 0);
  return mapRgb(toneMapOperator(options.toneMap ?? 'neutral').map(mapRgb(rgb, (v) => v * scale)), srgbEncode);
}

/**
 * {@link toneMap} for a whole image.
 *
 * @param rgba Linear RGBA, stride 4, row-major, with RGB already multiplied by alpha, as a path tracer's film holds it.
 * @returns sRGB codes, RGBA, stride 4; alpha linear and 0 where it was NaN.
 * @throws {ToneMapError} `tonemap/size` if the array does not hold width × height pixels; `tonemap/unknown`,
 * `tonemap/exposure`.
 */
export function toneMapPixels<O extends keyof Outputs = 'uint8'>(
  rgba: Float32Array,
  width: number,
  height: number,
  options: ToneMapPixelsOptions & { readonly output?: O } = {},
): Outputs[O] {
  const count = width * height;
  if (!Number.isInteger(width) || !Number.isInteger(height) || rgba.length !== count * 4) {
    throw new ToneMapError(
      'tonemap/size',
      `${width}×${height} RGBA pixels need ${count * 4} floats, but ${rgba.length} were given.`,
    );
  }
  checkToneMapOptions(options);
  const output = options.output ?? 'uint8';
  const { map } = toneMapOperator(options.toneMap ?? 'neutral');
  const exposure = 2 ** (options.exposure ?? 0);
  const straight = (options.alpha ?? 'straight') === 'straight';
  const out =
    output === 'uint8'
      ? new Uint8ClampedArray(count * 4)
      : output === 'uint16'
        ? new Uint16Array(count * 4)
        : new Float32Array(count * 4);
  const [top, round] = output === 'uint8' ? [255, 0.5] : output === 'uint16' ? [65535, 0.5] : [1, 0];
  const store = round === 0 ? (v: number) => v : (v: number) => Math.floor(v * top + round);
  const encode = output === 'uint8' ? srgbByteEncoder() : (v: number) => store(srgbEncode(v));
  // Not a new one for each pixel.
  const linear: [number, number, number] = [0, 0, 0];
  for (let i = 0; i < out.length; i += 4) {
    const coverage = rgba[i + 3] as number;
    const alpha = straight ? (coverage > 0 ? Math.min(coverage, 1) : 0) : 1;
    const scale = alpha > 0 ? exposure / alpha : 0;
    for (let k = 0; k < 3; k++) linear[k] = (rgba[i + k] as number) * scale;
    const mapped = map(linear, linear);
    for (let k = 0; k < 3; k++) out[i + k] = encode(mapped[k] as number);
    out[i + 3] = store(alpha);
  }
  return out as Outputs[O];
}

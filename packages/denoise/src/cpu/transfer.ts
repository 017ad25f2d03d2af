import {
  DENOISE_PU_A,
  DENOISE_PU_B,
  DENOISE_PU_C,
  DENOISE_PU_D,
  DENOISE_PU_E,
  DENOISE_PU_F,
  DENOISE_PU_G,
  DENOISE_PU_WHITE,
  DENOISE_PU_X0,
  DENOISE_PU_X1,
  DENOISE_PU_Y0,
  DENOISE_PU_Y1,
} from '../kernels/constants.wesl';
import type { DenoiserInput } from '../options';

const MAX_FLOAT = 3.4028234663852886e38;

/** NaN becomes 0; the rest is clamped. */
export const clean = (value: number, low: number, high: number): number =>
  Number.isNaN(value) ? 0 : Math.min(high, Math.max(low, value));

const puForward = (y: number) =>
  y <= DENOISE_PU_Y0
    ? DENOISE_PU_A * y
    : y <= DENOISE_PU_Y1
      ? DENOISE_PU_B * y ** DENOISE_PU_C + DENOISE_PU_D
      : DENOISE_PU_E * Math.log(y + DENOISE_PU_F) + DENOISE_PU_G;

const puInverse = (x: number) =>
  x <= DENOISE_PU_X0
    ? x / DENOISE_PU_A
    : x <= DENOISE_PU_X1
      ? ((x - DENOISE_PU_D) / DENOISE_PU_B) ** (1 / DENOISE_PU_C)
      : Math.exp((x - DENOISE_PU_G) / DENOISE_PU_E) - DENOISE_PU_F;

const srgbForward = (y: number) => (y <= 0.0031308 ? 12.92 * y : 1.055 * y ** (1 / 2.4) - 0.055);
const srgbInverse = (x: number) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);

/** A channel of the image to denoise as the network takes it. `scale` counts for `hdr` alone. */
export function encodeMain(value: number, input: DenoiserInput, scale: number): number {
  switch (input) {
    case 'hdr':
      return puForward(clean(value * scale, 0, MAX_FLOAT)) / puForward(DENOISE_PU_WHITE);
    case 'srgb':
      return clean(value, 0, 1);
    case 'normal':
      return encodeNormal(value);
    default:
      return srgbForward(clean(value, 0, 1));
  }
}

/** A channel of a guiding albedo as the network takes it: linear, unlike an albedo that is denoised itself. */
export const encodeAlbedo = (value: number): number => clean(value, 0, 1);

/** A channel of a normal as the network takes it. */
export const encodeNormal = (value: number): number => clean(value, -1, 1) * 0.5 + 0.5;

/** The inverse of {@link encodeMain}, of what the network returns. */
export function decodeMain(code: number, input: DenoiserInput, scale: number): number {
  const x = clean(code, 0, MAX_FLOAT);
  switch (input) {
    case 'hdr':
      return puInverse(x * puForward(DENOISE_PU_WHITE)) / scale;
    case 'srgb':
      return Math.min(x, 1);
    case 'normal':
      return Math.min(Math.max(2 * x - 1, -1), 1);
    default:
      return Math.min(srgbInverse(x), 1);
  }
}

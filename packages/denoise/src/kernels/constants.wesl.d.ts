import type { WgslModule } from '@glanz/wgsl';

/** The curve of HDR images, perceptually uniform: a·y up to y0, b·y^c + d up to y1, e·ln(y + f) + g above. */
export const DENOISE_PU_A: number;
export const DENOISE_PU_B: number;
export const DENOISE_PU_C: number;
export const DENOISE_PU_D: number;
export const DENOISE_PU_E: number;
export const DENOISE_PU_F: number;
export const DENOISE_PU_G: number;
/** Where the pieces meet, in radiance. */
export const DENOISE_PU_Y0: number;
export const DENOISE_PU_Y1: number;
/** Where the pieces meet, on the curve. */
export const DENOISE_PU_X0: number;
export const DENOISE_PU_X1: number;
/** The largest radiance that the networks were trained on, that of half precision: its code is 1. */
export const DENOISE_PU_WHITE: number;
/** What automatic exposure brings the geometric mean of the image's luminance to. */
export const DENOISE_KEY: number;
/** Blocks of at most so many pixels along each side are averaged for it. */
export const DENOISE_EXPOSURE_BLOCK: number;
/** Blocks of a mean luminance below count as black. */
export const DENOISE_BLACK: number;
/** Weights of red, green and blue in luminance. */
export const DENOISE_LUMINANCE: readonly [number, number, number];

declare const module: WgslModule;
export default module;

import type { WgslModule } from '@glanz/wgsl';

/** Errors are estimated over tiles of so many pixels along each side. */
export const BLEND_TILE: number;
/** Relative noise, as a standard deviation, that the eye begins to see: with more of it the denoised image counts more. */
export const BLEND_VISIBLE: number;
/** Relative noise below which the film is shown as it is, bit for bit: less than a step of an 8-bit image. */
export const BLEND_CONVERGED: number;
/** A pixel further from the mean of its neighbours than this many standard deviations is treated as noise. */
export const BLEND_OUTLIER: number;

declare const module: WgslModule;
export default module;

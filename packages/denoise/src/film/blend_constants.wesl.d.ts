import type { WgslModule } from '@glanz/wgsl';

/** Errors are estimated over tiles of so many pixels along each side. */
export const BLEND_TILE: number;
/** Relative noise, as a standard deviation, that the eye begins to see: with more of it the denoised image counts more. */
export const BLEND_VISIBLE: number;
/** Relative noise below which the film is shown as it is, bit for bit: less than a step of an 8-bit image. */
export const BLEND_CONVERGED: number;
/** A pixel that differs by more than so many standard deviations of its surroundings is noise itself. */
export const BLEND_OUTLIER: number;

declare const module: WgslModule;
export default module;

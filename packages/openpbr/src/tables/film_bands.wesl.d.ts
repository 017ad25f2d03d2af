import type { WgslModule } from '@glanz/wgsl';

/** A thin film's bands of the visible spectrum, of Lorentzian shape over wavenumbers: their middles, in 1/µm. */
export const OPENPBR_FILM_BANDS: readonly [number, number, number, number];
/** Coherence is lost by e^(−width · optical path in µm). */
export const OPENPBR_FILM_WIDTH: number;
/** What each band counts for red, green and blue, a row each, which sums to 1. */
export const OPENPBR_FILM_WEIGHTS: readonly (readonly [number, number, number, number])[];
/** The same for its wave a quarter of a turn later; each row sums to 0. */
export const OPENPBR_FILM_SINES: readonly (readonly [number, number, number, number])[];

declare const module: WgslModule;
export default module;

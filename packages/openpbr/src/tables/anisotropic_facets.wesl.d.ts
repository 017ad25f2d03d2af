import type { WgslModule } from '@glanz/wgsl';

/**
 * Facets that an anisotropic dielectric's energies from outside are summed over: of those that mirror upwards, and of
 * all, around the cap at each height.
 */
export const OPENPBR_ANISOTROPIC_MIRRORS: number;
export const OPENPBR_ANISOTROPIC_AROUND: number;
/**
 * Heights of the cap, and weights of what each facet there passes: Gauss and Legendre's over the root of the rest,
 * since what passes vanishes at the rim.
 */
export const OPENPBR_ANISOTROPIC_HEIGHTS: readonly (readonly [number, number])[];

declare const module: WgslModule;
export default module;

import type { WgslModule } from '@glanz/wgsl';

/**
 * Facets that an anisotropic dielectric's energies from outside are summed over: of those that mirror upwards, and of
 * all.
 */
export const OPENPBR_ANISOTROPIC_MIRRORS: number;
export const OPENPBR_ANISOTROPIC_FACETS: number;

declare const module: WgslModule;
export default module;

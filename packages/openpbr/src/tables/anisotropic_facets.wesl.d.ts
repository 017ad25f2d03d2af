import type { WgslModule } from '@glanz/wgsl';

/**
 * The ratio of slopes from which anisotropy is mild. Facets for any anisotropy come first, those for mild ones follow:
 * where the first end, and the second, of either table.
 */
export const OPENPBR_ANISOTROPIC_MILD: number;
export const OPENPBR_ANISOTROPIC_ENDS: readonly [number, number, number, number];
/** Of those that mirror upwards: places within their bounds, from 0 to 1. */
export const OPENPBR_ANISOTROPIC_MIRRORS: readonly (readonly [number, number, number])[];
/** Of all: the place across is tan χ. */
export const OPENPBR_ANISOTROPIC_FACETS: readonly (readonly [number, number, number])[];

declare const module: WgslModule;
export default module;

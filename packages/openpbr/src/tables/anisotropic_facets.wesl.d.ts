import type { WgslModule } from '@glanz/wgsl';

export const OPENPBR_ANISOTROPIC_MIRROR_COUNT: number;
export const OPENPBR_ANISOTROPIC_FACET_COUNT: number;
/** Of those that mirror upwards: places within their bounds, from 0 to 1. */
export const OPENPBR_ANISOTROPIC_MIRRORS: readonly (readonly [number, number, number])[];
/** Of all: the place across is sin χ. */
export const OPENPBR_ANISOTROPIC_FACETS: readonly (readonly [number, number, number, number])[];

declare const module: WgslModule;
export default module;

import type { WgslModule } from '@glanz/wgsl';

/** The tables' first roughness, which is that of the smallest slope. */
export const OPENPBR_MIN_ROUGHNESS: number;
/** The block of anisotropic mirrors holds the anisotropies 1/n, 2/n, … 1. */
export const OPENPBR_ANISOTROPIC_FLATS: number;
/** Nearer to index 1 than this ε the tables are too coarse for what is seen from inside: it is summed over facets. */
export const OPENPBR_INSIDE_NEAR: number;

declare const module: WgslModule;
export default module;

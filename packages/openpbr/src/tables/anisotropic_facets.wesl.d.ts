import type { WgslModule } from '@glanz/wgsl';

export const OPENPBR_ANISOTROPIC_MIRROR_COUNT: number;
export const OPENPBR_ANISOTROPIC_FACET_COUNT: number;
/**
 * Facets of an anisotropic dielectric that mirror upwards: where they are along the view and across it, from 0 to 1
 * within their bounds, and what they count.
 */
export const OPENPBR_ANISOTROPIC_MIRRORS: readonly (readonly [along: number, across: number, weight: number])[];
/**
 * Facets of all that are seen: where they are along the view, from 0 to 1, the sine of the angle across it, its cosine,
 * and what they count, which adds up to 1.
 */
export const OPENPBR_ANISOTROPIC_FACETS: readonly (readonly [
  along: number,
  sine: number,
  cosine: number,
  weight: number,
])[];

declare const module: WgslModule;
export default module;

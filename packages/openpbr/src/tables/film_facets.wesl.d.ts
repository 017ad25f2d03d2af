import type { WgslModule } from '@glanz/wgsl';

/**
 * Facets that a thin film's changes of an interface's albedos are summed over: how far up the cap of visible normals,
 * from 0 to 1, cosine and sine of the angle to the view's azimuth, and the weight. Those for views from outside come
 * first, those from inside follow: where the first end, and the second.
 */
export const OPENPBR_FILM_FACET_ENDS: readonly [number, number];
export const OPENPBR_FILM_FACETS: readonly (readonly [number, number, number, number])[];

declare const module: WgslModule;
export default module;

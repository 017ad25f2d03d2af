import type { WgslModule } from '@glanz/wgsl';

/**
 * Gauss and Legendre's nodes and weights, halved to 0 to 1: for the mean share of an interface that is summed over
 * facets, on either side of the critical angle.
 */
export const OPENPBR_INNER_SUM_NODES: readonly (readonly [number, number])[];

declare const module: WgslModule;
export default module;

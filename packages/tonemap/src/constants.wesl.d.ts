import type { WgslModule } from '@glanz/wgsl';

/**
 * The brightest value a view transform computes with: 2^20, twenty stops above white. Everything brighter is white in
 * all of them, and squares of it stay far from overflow in 32-bit floats.
 */
export const TONEMAP_MAX: number;

declare const module: WgslModule;
export default module;

import type { WgslModule } from '@glanz/wgsl';

export const OPENPBR_TABLE_ANGLES: number;
export const OPENPBR_TABLE_ROUGHNESSES: number;
export const OPENPBR_TABLE_OUTER: number;
export const OPENPBR_TABLE_OUTER_TOTAL: number;
export const OPENPBR_TABLE_INNER: number;
export const OPENPBR_TABLE_INNER_TOTAL: number;
export const OPENPBR_TABLE_ANISOTROPIC: number;
export const OPENPBR_TABLE_CONDUCTOR: number;
export const OPENPBR_TABLE_SHEEN: number;

declare const module: WgslModule;
export default module;

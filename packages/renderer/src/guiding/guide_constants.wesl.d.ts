import type { WgslModule } from '@glanz/wgsl';

/** Rows of the bins of directions, along x. */
export const GUIDE_ROWS: number;
/** Bins around x in each row. */
export const GUIDE_COLUMNS: number;
/** Bins of directions: rows times columns. */
export const GUIDE_BINS: number;
/** Points of each leaf at which training paths start. */
export const GUIDE_POINTS: number;
/** Numbers in a row of the guide's texture. */
export const GUIDE_WIDTH: number;

declare const module: WgslModule;
export default module;

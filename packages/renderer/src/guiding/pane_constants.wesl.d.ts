import type { WgslModule } from '@glanz/wgsl';

/** Rows of the bins of directions, along x. */
export const PANE_ROWS: number;
/** Bins around x in each row. */
export const PANE_COLUMNS: number;
/** Bins of directions: rows times columns. */
export const PANE_BINS: number;
/** Numbers in a row of the guide's texture. */
export const PANE_WIDTH: number;
/** The share of directions that are chosen towards light behind panes, by the environment's own distribution. */
export const PANE_BEHIND: number;

declare const module: WgslModule;
export default module;

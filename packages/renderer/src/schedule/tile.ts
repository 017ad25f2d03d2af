/** Sides of the tiles in which noise is measured, pixels: a workgroup has a thread for each. */
export const TILE = 8;

// Bundlers find an asset by the text "new URL('…', import.meta.url)": the path must stand in it as a literal.

/**
 * Address of `rt_ldr_alb_nrm_small.tza` (0.64 MB): LDR colour with albedo and normal as guides, small. Nothing is
 * downloaded.
 */
export const ldrSmallUrl = (): URL => new URL('../weights/rt_ldr_alb_nrm_small.tza', import.meta.url);

/** Address of `rt_ldr_small.tza` (0.63 MB): LDR colour without guides, small. Nothing is downloaded. */
export const ldrSmallColorUrl = (): URL => new URL('../weights/rt_ldr_small.tza', import.meta.url);

/**
 * Address of `rt_ldr_alb_small.tza` (0.64 MB): LDR colour with albedo as the only guide, small. Nothing is
 * downloaded.
 */
export const ldrSmallAlbedoUrl = (): URL => new URL('../weights/rt_ldr_alb_small.tza', import.meta.url);

/**
 * Address of `rt_ldr_calb_cnrm_small.tza` (0.64 MB): LDR colour with albedo and normal that are free of noise, small.
 * Nothing is downloaded.
 */
export const ldrSmallCleanUrl = (): URL => new URL('../weights/rt_ldr_calb_cnrm_small.tza', import.meta.url);

/**
 * Address of `rt_ldr_alb_nrm.tza` (1.84 MB): LDR colour with albedo and normal as guides, base. Nothing is
 * downloaded.
 */
export const ldrUrl = (): URL => new URL('../weights/rt_ldr_alb_nrm.tza', import.meta.url);

/** Address of `rt_ldr.tza` (1.83 MB): LDR colour without guides, base. Nothing is downloaded. */
export const ldrColorUrl = (): URL => new URL('../weights/rt_ldr.tza', import.meta.url);

/** Address of `rt_ldr_alb.tza` (1.84 MB): LDR colour with albedo as the only guide, base. Nothing is downloaded. */
export const ldrAlbedoUrl = (): URL => new URL('../weights/rt_ldr_alb.tza', import.meta.url);

/**
 * Address of `rt_ldr_calb_cnrm.tza` (1.84 MB): LDR colour with albedo and normal that are free of noise, base.
 * Nothing is downloaded.
 */
export const ldrCleanUrl = (): URL => new URL('../weights/rt_ldr_calb_cnrm.tza', import.meta.url);

// Bundlers find an asset by the text "new URL('…', import.meta.url)": the path must stand in it as a literal.

/**
 * Address of `rt_hdr_alb_nrm_small.tza` (0.64 MB): HDR colour with albedo and normal as guides: the network of the
 * quality `fast`. Nothing is downloaded.
 */
export const smallUrl = (): URL => new URL('../weights/rt_hdr_alb_nrm_small.tza', import.meta.url);

/** Address of `rt_hdr_small.tza` (0.63 MB): HDR colour without guides. Nothing is downloaded. */
export const smallColorUrl = (): URL => new URL('../weights/rt_hdr_small.tza', import.meta.url);

/** Address of `rt_hdr_alb_small.tza` (0.64 MB): HDR colour with albedo as the only guide. Nothing is downloaded. */
export const smallAlbedoUrl = (): URL => new URL('../weights/rt_hdr_alb_small.tza', import.meta.url);

/**
 * Address of `rt_hdr_calb_cnrm_small.tza` (0.64 MB): HDR colour with albedo and normal that are free of noise.
 * Nothing is downloaded.
 */
export const smallCleanUrl = (): URL => new URL('../weights/rt_hdr_calb_cnrm_small.tza', import.meta.url);

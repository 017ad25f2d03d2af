// Bundlers find an asset by the text "new URL('…', import.meta.url)": the path must stand in it as a literal.

/**
 * Address of `rt_hdr_alb_nrm.tza` (1.84 MB): HDR colour with albedo and normal as guides: the network of the quality
 * `balanced`. Nothing is downloaded.
 */
export const baseUrl = (): URL => new URL('../weights/rt_hdr_alb_nrm.tza', import.meta.url);

/** Address of `rt_hdr.tza` (1.83 MB): HDR colour without guides. Nothing is downloaded. */
export const baseColorUrl = (): URL => new URL('../weights/rt_hdr.tza', import.meta.url);

/** Address of `rt_hdr_alb.tza` (1.84 MB): HDR colour with albedo as the only guide. Nothing is downloaded. */
export const baseAlbedoUrl = (): URL => new URL('../weights/rt_hdr_alb.tza', import.meta.url);

/**
 * Address of `rt_hdr_calb_cnrm.tza` (1.84 MB): HDR colour with albedo and normal that are free of noise. Nothing is
 * downloaded.
 */
export const baseCleanUrl = (): URL => new URL('../weights/rt_hdr_calb_cnrm.tza', import.meta.url);

/** Address of `rt_alb.tza` (1.83 MB): removes the noise of an albedo guide. Nothing is downloaded. */
export const albedoUrl = (): URL => new URL('../weights/rt_alb.tza', import.meta.url);

/** Address of `rt_nrm.tza` (1.83 MB): removes the noise of a normal guide. Nothing is downloaded. */
export const normalUrl = (): URL => new URL('../weights/rt_nrm.tza', import.meta.url);

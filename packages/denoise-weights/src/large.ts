/**
 * Address of `rt_hdr_calb_cnrm_large.tza` (7.70 MB): HDR colour with albedo and normal that are free of noise: the
 * network of the quality `best`, after the two others have removed the noise of the guides. Nothing is downloaded.
 */
export const largeUrl = (): URL => new URL('../weights/rt_hdr_calb_cnrm_large.tza', import.meta.url);

/** Address of `rt_alb_large.tza` (7.68 MB): removes the noise of an albedo guide. Nothing is downloaded. */
export const largeAlbedoUrl = (): URL => new URL('../weights/rt_alb_large.tza', import.meta.url);

/** Address of `rt_nrm_large.tza` (7.68 MB): removes the noise of a normal guide. Nothing is downloaded. */
export const largeNormalUrl = (): URL => new URL('../weights/rt_nrm_large.tza', import.meta.url);

/**
 * Address of `rt_hdr_alb_nrm.tza` (1.84 MB): HDR colour with albedo and normal as guides: the network of the quality
 * `balanced`. Nothing is downloaded.
 */
export const baseUrl = (): URL => new URL('../weights/rt_hdr_alb_nrm.tza', import.meta.url);

/**
 * Address of `rt_hdr_alb_nrm_small.tza` (0.64 MB): HDR colour with albedo and normal as guides: the network of the
 * quality `fast`. Nothing is downloaded.
 */
export const smallUrl = (): URL => new URL('../weights/rt_hdr_alb_nrm_small.tza', import.meta.url);

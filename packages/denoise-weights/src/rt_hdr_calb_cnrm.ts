/**
 * Address of `rt_hdr_calb_cnrm.tza` (1.84 MB): HDR colour with albedo and normal that are free of noise. Nothing is
 * downloaded.
 */
export const url = (): URL => new URL('../weights/rt_hdr_calb_cnrm.tza', import.meta.url);

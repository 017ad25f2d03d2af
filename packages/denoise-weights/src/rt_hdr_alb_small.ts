/** Address of `rt_hdr_alb_small.tza` (0.64 MB): HDR colour with albedo as the only guide. Nothing is downloaded. */
export const url = (): URL => new URL('../weights/rt_hdr_alb_small.tza', import.meta.url);

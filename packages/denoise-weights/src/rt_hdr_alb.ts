/** Address of `rt_hdr_alb.tza` (1.84 MB): HDR colour with albedo as the only guide. Nothing is downloaded. */
export const url = (): URL => new URL('../weights/rt_hdr_alb.tza', import.meta.url);

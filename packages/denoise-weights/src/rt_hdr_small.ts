/** Address of `rt_hdr_small.tza` (0.63 MB): HDR colour without guides. Nothing is downloaded. */
export const url = (): URL => new URL('../weights/rt_hdr_small.tza', import.meta.url);

/** Address of `rt_hdr.tza` (1.83 MB): HDR colour without guides. Nothing is downloaded. */
export const url = (): URL => new URL('../weights/rt_hdr.tza', import.meta.url);

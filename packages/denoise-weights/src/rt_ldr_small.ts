/** Address of `rt_ldr_small.tza` (0.63 MB): LDR colour without guides. Nothing is downloaded. */
export const url = (): URL => new URL('../weights/rt_ldr_small.tza', import.meta.url);

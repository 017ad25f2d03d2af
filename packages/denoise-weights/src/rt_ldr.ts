/** Address of `rt_ldr.tza` (1.83 MB): LDR colour without guides. Nothing is downloaded. */
export const url = (): URL => new URL('../weights/rt_ldr.tza', import.meta.url);

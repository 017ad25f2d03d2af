/** Address of `rt_ldr_alb_nrm.tza` (1.84 MB): LDR colour with albedo and normal as guides. Nothing is downloaded. */
export const url = (): URL => new URL('../weights/rt_ldr_alb_nrm.tza', import.meta.url);

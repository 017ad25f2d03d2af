/**
 * Address of `rt_ldr_alb_nrm_small.tza` (0.64 MB): LDR colour with albedo and normal as guides. Nothing is downloaded.
 */
export const url = (): URL => new URL('../weights/rt_ldr_alb_nrm_small.tza', import.meta.url);

/**
 * Address of `rt_ldr_calb_cnrm_small.tza` (0.64 MB): LDR colour with albedo and normal that are free of noise. Nothing
 * is downloaded.
 */
export const url = (): URL => new URL('../weights/rt_ldr_calb_cnrm_small.tza', import.meta.url);

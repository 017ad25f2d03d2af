/** Address of `rt_ldr_alb_small.tza` (0.64 MB): LDR colour with albedo as the only guide. Nothing is downloaded. */
export const url = (): URL => new URL('../weights/rt_ldr_alb_small.tza', import.meta.url);

/** Address of `rt_ldr_alb.tza` (1.84 MB): LDR colour with albedo as the only guide. Nothing is downloaded. */
export const url = (): URL => new URL('../weights/rt_ldr_alb.tza', import.meta.url);

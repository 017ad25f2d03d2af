/** Address of `rt_alb.tza` (1.83 MB): removes the noise of an albedo guide. Nothing is downloaded. */
export const url = (): URL => new URL('../weights/rt_alb.tza', import.meta.url);

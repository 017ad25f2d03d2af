/** Address of `rt_nrm.tza` (1.83 MB): removes the noise of a normal guide. Nothing is downloaded. */
export const url = (): URL => new URL('../weights/rt_nrm.tza', import.meta.url);

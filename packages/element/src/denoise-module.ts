import type { Denoising, Viewer } from '@glanz/viewer';
import { ElementError } from './errors';
import { importDefault } from './import-default';

/**
 * Makes a viewer denoise its images by what a module exports.
 *
 * @param address Absolute or relative to the page; without one, images are shown with their noise.
 * @param current Whether the viewer still has to use this address: modules may come late, or in another order.
 * @throws {ElementError} `element/denoise`, after which the viewer shows its images with their noise.
 */
export async function denoiseBy(viewer: Viewer, address: string | null, current: () => boolean): Promise<void> {
  viewer.denoise = undefined;
  if (!address) return;
  try {
    // The viewer refuses what denoising() has not made; a module without a default export has null.
    const denoise = (await importDefault(address)) ?? null;
    if (current()) viewer.denoise = denoise as Denoising;
  } catch (cause) {
    if (current())
      throw new ElementError(
        'element/denoise',
        `The denoiser does not start (denoise="${address}"): ${(cause as Error).message}`,
        { cause },
      );
  }
}

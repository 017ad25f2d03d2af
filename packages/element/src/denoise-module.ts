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
  try {
    const denoise = address ? await importDefault(address) : undefined;
    if (!current()) return;
    if (address && typeof denoise !== 'function')
      throw new Error('its default export is not what denoising() of @glanz/viewer/denoise returns');
    viewer.denoise = denoise as Denoising | undefined;
  } catch (cause) {
    if (!current()) return;
    viewer.denoise = undefined;
    throw new ElementError(
      'element/denoise',
      `The image is shown with its noise, since its denoiser does not load (denoise="${address}"): ${(cause as Error).message}`,
      { cause },
    );
  }
}

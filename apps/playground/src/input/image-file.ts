import { OPENPBR_PARAMETER_SPECS } from '@glanz/openpbr/parameters';
import type { Image, TexturedParameter } from '@glanz/scene';
import { PlaygroundError } from '../errors';
import type { Slot } from '../state/state';

/**
 * Decodes an image for a texture.
 *
 * @throws {PlaygroundError} `playground/image` where the browser cannot read it.
 */
export async function readImage(file: File): Promise<Image> {
  const { decodeImageInBrowser } = await import('@glanz/gltf');
  try {
    const { width, height, data } = await decodeImageInBrowser(
      new Uint8Array(await file.arrayBuffer()),
      file.type || 'application/octet-stream',
    );
    return { name: file.name, width, height, data: data as Image['data'] };
  } catch {
    throw new PlaygroundError(
      'playground/image',
      `"${file.name}" is not an image that this browser can decode: use PNG, JPEG, WebP or AVIF.`,
    );
  }
}

/** The image as it drives a parameter: colours as sRGB, numbers by their red channel. */
export function slotOf(image: Image, parameter: TexturedParameter): NonNullable<Slot> {
  const { type } = OPENPBR_PARAMETER_SPECS[parameter];
  return {
    image,
    color_space: type === 'color3' ? 'srgb' : 'linear',
    binding: { channels: type === 'float' ? 'r' : 'rgb' },
  };
}

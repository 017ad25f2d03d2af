import { applyGainMap, findGainMap } from '@glanz/image/gain-map';
import type { LatLongEnvironment } from '@glanz/scene';
import { srgbDecode } from '@glanz/tonemap';
import { ViewerError } from './errors';

/** The codes of an image, RGBA. @throws {ViewerError} `viewer/environment` where the browser cannot read it */
async function pixelsOf(bytes: Uint8Array<ArrayBuffer>, options?: ImageBitmapOptions): Promise<ImageData> {
  let bitmap: ImageBitmap;
  try {
    bitmap = await createImageBitmap(new Blob([bytes]), options);
  } catch (cause) {
    throw new ViewerError('viewer/environment', 'The browser cannot read the image of the environment.', { cause });
  }
  const { width, height } = bitmap;
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  if (!context) throw new ViewerError('viewer/environment', 'The image of the environment is too large to be read.');
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  return context.getImageData(0, 0, width, height);
}

/**
 * Reads a JPEG, PNG or WebP image as an environment, with its colours as sRGB. Radiance is at most 1, so a sun in it
 * casts a weak shadow, except in an Ultra HDR JPEG, whose gain map is applied at full strength.
 *
 * @throws {ViewerError} `viewer/environment` where the browser cannot read it.
 * @throws {ImageError} `image/truncated`, `image/corrupt`, `image/unsupported` for metadata of ISO 21496-1 that is none.
 */
export async function ldrEnvironment(bytes: Uint8Array<ArrayBuffer>): Promise<LatLongEnvironment> {
  const { width, height, data: codes } = await pixelsOf(bytes);
  const table = Float32Array.from({ length: 256 }, (_, byte) => srgbDecode(byte / 255));
  const data = new Float32Array(3 * width * height);
  for (let i = 0, from = 0; i < data.length; i += 3, from += 4)
    for (let k = 0; k < 3; k++) data[i + k] = table[codes[from + k] as number] as number;
  const map = findGainMap(bytes);
  // The codes of the map are numbers, not colours.
  if (map) applyGainMap(data, width, height, map, await pixelsOf(map.jpeg, { colorSpaceConversion: 'none' }));
  return { type: 'latlong', width, height, data };
}

import type { LatLongEnvironment } from '@glanz/scene';
import { srgbDecode } from '@glanz/tonemap';
import { ViewerError } from './errors';

/**
 * Reads an image of low dynamic range as an environment, with its colours as sRGB: radiance is at most 1, so a sun in
 * it casts a weak shadow.
 *
 * @throws {ViewerError} `viewer/environment` where the browser cannot read it.
 */
export async function ldrEnvironment(bytes: Uint8Array<ArrayBuffer>): Promise<LatLongEnvironment> {
  let bitmap: ImageBitmap;
  try {
    bitmap = await createImageBitmap(new Blob([bytes]));
  } catch (cause) {
    throw new ViewerError('viewer/environment', 'The browser cannot read the image of the environment.', { cause });
  }
  const { width, height } = bitmap;
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  if (!context) throw new ViewerError('viewer/environment', 'The image of the environment is too large to be read.');
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  const pixels = context.getImageData(0, 0, width, height).data;
  const table = Float32Array.from({ length: 256 }, (_, byte) => srgbDecode(byte / 255));
  const data = new Float32Array(3 * width * height);
  for (let i = 0, from = 0; i < data.length; i += 3, from += 4)
    for (let k = 0; k < 3; k++) data[i + k] = table[pixels[from + k] as number] as number;
  return { type: 'latlong', width, height, data };
}

import type { GltfPictureConversion } from '@glanz/openpbr/gltf';
import type { DecodedImage } from './images';

/** A picture to be made of others, texel by texel. */
export interface DerivedPicture {
  readonly colorSpace: 'srgb' | 'linear';
  readonly convert: GltfPictureConversion['convert'];
}

const srgbToLinear = (c: number) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
const linearToSrgb = (c: number) => (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055);

/** Steps of the table of codes: the curve rises by 12.92 at most, so that a step is a fifth of a code. */
const STEPS = 16384;

/** How long the work may hold its thread, in milliseconds. */
const TURN = 8;

/**
 * Makes a picture of others. It has the size of the largest; smaller ones give their nearest texels. Lets others have the
 * thread every few milliseconds.
 */
export async function convertImage(sources: readonly DecodedImage[], { colorSpace, convert }: DerivedPicture, signal: AbortSignal | undefined): Promise<DecodedImage> {
  const width = Math.max(...sources.map((source) => source.width));
  const height = Math.max(...sources.map((source) => source.height));
  const decode = Float32Array.from({ length: 256 }, (_, code) => (colorSpace === 'srgb' ? srgbToLinear(code / 255) : code / 255));
  const encode = Uint8Array.from({ length: STEPS + 1 }, (_, step) => Math.round(255 * (colorSpace === 'srgb' ? linearToSrgb(step / STEPS) : step / STEPS)));
  const data = new Uint8Array(4 * width * height);
  const texels = new Float32Array(4 * sources.length);
  const result = new Float32Array(4);
  let until = performance.now() + TURN;
  for (let y = 0; y < height; y++) {
    if (performance.now() > until) {
      await new Promise((resolve) => setTimeout(resolve));
      signal?.throwIfAborted();
      until = performance.now() + TURN;
    }
    for (let x = 0; x < width; x++) {
      for (const [k, source] of sources.entries()) {
        const at = 4 * (Math.floor(((y + 0.5) * source.height) / height) * source.width + Math.floor(((x + 0.5) * source.width) / width));
        for (let c = 0; c < 3; c++) texels[4 * k + c] = decode[source.data[at + c] as number] as number;
        texels[4 * k + 3] = (source.data[at + 3] as number) / 255;
      }
      convert(texels, result);
      const at = 4 * (y * width + x);
      for (let c = 0; c < 3; c++) data[at + c] = encode[Math.round(STEPS * Math.min(Math.max(result[c] as number, 0), 1))] as number;
      data[at + 3] = Math.round(255 * Math.min(Math.max(result[3] as number, 0), 1));
    }
  }
  return { width, height, data };
}

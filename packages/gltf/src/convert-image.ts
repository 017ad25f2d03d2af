import type { GltfImageConversion } from '@glanz/openpbr/gltf';
import type { DecodedImage } from './decoded-image';

/** How an image is computed from others, texel by texel. */
export interface DerivedImage {
  readonly colorSpace: 'srgb' | 'linear';
  readonly convert: GltfImageConversion['convert'];
}

const srgbToLinear = (c: number) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
const linearToSrgb = (c: number) => (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055);

/** Entries of the encoding table. The slope of the sRGB curve is at most 12.92, so one entry is a fifth of a code. */
const STEPS = 16384;

/** Milliseconds between yields to the event loop. */
const SLICE_MS = 8;

/**
 * Computes an image from others, at the size of the largest; smaller ones are sampled at the nearest texel. Yields to
 * the event loop every few milliseconds.
 */
export async function convertImage(
  sources: readonly DecodedImage[],
  { colorSpace, convert }: DerivedImage,
  signal: AbortSignal | undefined,
): Promise<DecodedImage> {
  const width = Math.max(...sources.map((source) => source.width));
  const height = Math.max(...sources.map((source) => source.height));
  const decode = Float32Array.from({ length: 256 }, (_, code) =>
    colorSpace === 'srgb' ? srgbToLinear(code / 255) : code / 255,
  );
  const encode = Uint8Array.from({ length: STEPS + 1 }, (_, step) =>
    Math.round(255 * (colorSpace === 'srgb' ? linearToSrgb(step / STEPS) : step / STEPS)),
  );
  const data = new Uint8Array(4 * width * height);
  const texels = new Float32Array(4 * sources.length);
  const result = new Float32Array(4);
  // Images have areas of one colour: reuse the result while the source texels repeat.
  const codes = new Int32Array(sources.length).fill(-1),
    before = new Int32Array(sources.length).fill(-1);
  const words = sources.map(
    (source) => new DataView(source.data.buffer, source.data.byteOffset, source.data.byteLength),
  );
  const rows = sources.map(() => 0);
  let until = performance.now() + SLICE_MS;
  let first = true;
  for (let y = 0, to = 0; y < height; y++) {
    if (performance.now() > until) {
      await new Promise((resolve) => setTimeout(resolve));
      signal?.throwIfAborted();
      until = performance.now() + SLICE_MS;
    }
    for (let k = 0; k < sources.length; k++)
      rows[k] =
        Math.floor(((y + 0.5) * (sources[k] as DecodedImage).height) / height) * (sources[k] as DecodedImage).width;
    for (let x = 0; x < width; x++, to += 4) {
      let same = !first;
      for (let k = 0; k < sources.length; k++) {
        const source = sources[k] as DecodedImage;
        const column = source.width === width ? x : Math.floor(((x + 0.5) * source.width) / width);
        codes[k] = (words[k] as DataView).getInt32(4 * ((rows[k] as number) + column), true);
        same &&= codes[k] === before[k];
      }
      if (same) {
        data.copyWithin(to, to - 4, to);
        continue;
      }
      first = false;
      for (let k = 0; k < sources.length; k++) {
        const code = (before[k] = codes[k] as number);
        texels[4 * k] = decode[code & 255] as number;
        texels[4 * k + 1] = decode[(code >> 8) & 255] as number;
        texels[4 * k + 2] = decode[(code >> 16) & 255] as number;
        texels[4 * k + 3] = (code >>> 24) / 255;
      }
      convert(texels, result);
      for (let c = 0; c < 3; c++)
        data[to + c] = encode[Math.round(STEPS * Math.min(Math.max(result[c] as number, 0), 1))] as number;
      data[to + 3] = Math.round(255 * Math.min(Math.max(result[3] as number, 0), 1));
    }
  }
  return { width, height, data };
}

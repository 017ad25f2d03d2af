import type { GltfImageConversion } from '@glanz/openpbr/gltf';
import type { Image } from '@glanz/scene';

const decode = (value: number) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);
const encode = (value: number) => (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055);

/**
 * Makes the image that a conversion asks for, as large as the largest of its sources; those that are missing are
 * white.
 */
export function convertImage(
  name: string,
  sources: readonly (Image | undefined)[],
  conversion: GltfImageConversion,
  colorSpace: 'srgb' | 'linear',
): Image {
  const width = Math.max(1, ...sources.map((image) => image?.width ?? 1));
  const height = Math.max(1, ...sources.map((image) => image?.height ?? 1));
  const pixels = sources.map(
    (image) => image && { image, data: image.data, scale: image.data instanceof Float32Array ? 1 : 1 / 255 },
  );
  const out = new Uint8Array(width * height * 4);
  const texels = new Float64Array(4 * sources.length);
  const result = new Float64Array(4);
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) {
      pixels.forEach((source, s) => {
        if (!source) return void texels.fill(1, 4 * s, 4 * s + 4);
        const { image, data, scale } = source;
        const at =
          4 *
          (Math.floor(((y + 0.5) / height) * image.height) * image.width +
            Math.floor(((x + 0.5) / width) * image.width));
        for (let k = 0; k < 4; k++) {
          const value = Math.min(1, Math.max(0, (data[at + k] as number) * scale));
          texels[4 * s + k] = k < 3 && colorSpace === 'srgb' ? decode(value) : value;
        }
      });
      conversion.convert(texels, result as unknown as { [channel: number]: number });
      for (let k = 0; k < 4; k++) {
        const value = Math.min(1, Math.max(0, result[k] as number));
        out[4 * (y * width + x) + k] = Math.round(255 * (k < 3 && colorSpace === 'srgb' ? encode(value) : value));
      }
    }
  return { name, width, height, data: out };
}

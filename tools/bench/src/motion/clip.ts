import { mkdirSync } from 'node:fs';
import { join } from 'node:path';

/** Milliseconds that a frame of a clip is shown. */
const DELAY = 50;
/** Pixels between images side by side. */
const GAP = 4;

/** Linear RGBA as sRGB shows it, in 8 bits: RGB from 0 to 255. */
export function shownBytes(rgba: Float32Array): Uint8Array {
  return Uint8Array.from({ length: (rgba.length / 4) * 3 }, (_, i) => {
    const v = Math.min(Math.max(rgba[4 * Math.floor(i / 3) + (i % 3)]!, 0), 1);
    return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
  });
}

/** Writes one image, RGB in 8 bits, as PNG. */
export async function writePng(file: string, rgb: Uint8Array, width: number, height: number): Promise<void> {
  const { default: sharp } = await import('sharp');
  await sharp(rgb, { raw: { width, height, channels: 3 } }).toFile(file);
}

/** Images of one size side by side, with white between them. */
export function sideBySide(images: readonly Uint8Array[], width: number, height: number): Uint8Array {
  const row = 3 * (images.length * (width + GAP) - GAP);
  const out = new Uint8Array(row * height).fill(255);
  for (const [i, image] of images.entries())
    for (let y = 0; y < height; y++)
      out.set(image.subarray(3 * width * y, 3 * width * (y + 1)), row * y + 3 * i * (width + GAP));
  return out;
}

/**
 * Writes an animated WebP of all frames, twenty a second.
 *
 * @param ways Of each way to show a frame, its frames as RGB in 8 bits; they stand side by side.
 * @returns The file's name.
 */
export async function writeClip(
  folder: string,
  title: string,
  ways: readonly (readonly Uint8Array[])[],
  width: number,
  height: number,
): Promise<string> {
  const { default: sharp } = await import('sharp');
  mkdirSync(folder, { recursive: true });
  const frames = ways[0]!.map((_, frame) =>
    sideBySide(
      ways.map((images) => images[frame]!),
      width,
      height,
    ),
  );
  const raw = { width: ways.length * (width + GAP) - GAP, height: frames.length * height, channels: 3 } as const;
  const file = join(folder, `${title.replace(', ', '-')}.webp`);
  await sharp(Buffer.concat(frames), { raw: { ...raw, pageHeight: height } })
    .webp({ quality: 45, effort: 6, loop: 0, delay: frames.map(() => DELAY) })
    .toFile(file);
  return file;
}

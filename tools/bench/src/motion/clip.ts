import { mkdirSync } from 'node:fs';
import { join } from 'node:path';

/** Milliseconds that a frame of a clip is shown. */
const DELAY = 50;
/** Pixels of a frame at most: all frames of a clip are in memory at once. */
export const CLIP_PIXELS = 640 * 360;
/** Pixels between images side by side. */
const GAP = 4;

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
 * @param name Of the file, without its end.
 * @param ways Of each way to show a frame, its frames as RGB in 8 bits; they stand side by side.
 * @returns The file's name.
 */
export async function writeClip(
  folder: string,
  name: string,
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
  const file = join(folder, `${name}.webp`);
  // Its limit is for images that one opens unseen.
  await sharp(Buffer.concat(frames), { raw: { ...raw, pageHeight: height }, limitInputPixels: false })
    .webp({ quality: 45, effort: 6, loop: 0, delay: frames.map(() => DELAY) })
    .toFile(file);
  return file;
}

import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { GalleryRecord } from './gallery';
import type { GalleryImage } from './manifest';

/** Largest file of an image, bytes. */
const MAX_BYTES = 150_000;

/**
 * Writes rendered images as WebP into the documentation, each as good as its limit of bytes allows, and merges what is
 * known of them into `apps/docs/gallery.json`. Runs in the root of the repository.
 *
 * @param folder Of a render: PNG files and gallery.json.
 */
export async function writeDocsImages(images: readonly GalleryImage[], folder: string): Promise<number> {
  const { default: sharp } = await import('sharp');
  const target = join('apps', 'docs', 'public', 'gallery');
  const facts = join('apps', 'docs', 'gallery', 'gallery.json');
  mkdirSync(target, { recursive: true });
  mkdirSync(join('apps', 'docs', 'gallery'), { recursive: true });
  const known = new Map<string, GalleryRecord>();
  for (const file of [facts, join(folder, 'gallery.json')])
    if (existsSync(file))
      for (const record of JSON.parse(readFileSync(file, 'utf8')) as GalleryRecord[]) known.set(record.id, record);
  for (const { id } of images) {
    const source = join(folder, `${id}.png`);
    if (!existsSync(source)) {
      process.stderr.write(`${source} is missing.\n`);
      continue;
    }
    let quality = 90;
    let bytes = await sharp(source).webp({ quality, effort: 6 }).toBuffer();
    while (bytes.byteLength > MAX_BYTES && quality > 40) {
      quality -= 5;
      bytes = await sharp(source).webp({ quality, effort: 6 }).toBuffer();
    }
    writeFileSync(join(target, `${id}.webp`), bytes);
    process.stdout.write(`${id}.webp: quality ${quality}, ${Math.round(bytes.byteLength / 1000)} kB\n`);
  }
  const records = images.flatMap(({ id }) => known.get(id) ?? []);
  writeFileSync(facts, `${JSON.stringify(records, null, 2)}\n`);
  return 0;
}

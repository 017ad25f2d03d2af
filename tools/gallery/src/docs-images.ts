import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { GalleryRecord } from './record';
import { commandOf } from './command';
import { GALLERY, LARGE_MODELS, type GalleryImage } from './manifest';

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
  const target = join('apps', 'docs', 'public', 'images');
  const facts = join('apps', 'docs', 'gallery.json');
  mkdirSync(target, { recursive: true });
  const known = new Map<string, GalleryRecord>();
  const remember = (records: readonly GalleryRecord[]) => records.forEach((record) => known.set(record.id, record));
  if (existsSync(facts)) remember((JSON.parse(readFileSync(facts, 'utf8')) as { images: GalleryRecord[] }).images);
  remember(JSON.parse(readFileSync(join(folder, 'gallery.json'), 'utf8')) as GalleryRecord[]);
  for (const { id } of images) {
    const source = join(folder, `${id}.png`);
    if (!existsSync(source)) {
      process.stderr.write(`${source} is missing.\n`);
      continue;
    }
    let quality = 90;
    let bytes = await sharp(source).webp({ quality, alphaQuality: quality, effort: 6 }).toBuffer();
    while (bytes.byteLength > MAX_BYTES && quality > 40) {
      quality -= 5;
      bytes = await sharp(source).webp({ quality, alphaQuality: quality, effort: 6 }).toBuffer();
    }
    writeFileSync(join(target, `${id}.webp`), bytes);
    process.stdout.write(`${id}.webp: quality ${quality}, ${Math.round(bytes.byteLength / 1000)} kB\n`);
  }
  // The page shows the entries of the manifest, in its order, with the texts of today and the samples that were rendered.
  const records = GALLERY.flatMap((image) => {
    const record = known.get(image.id);
    const { id, title, alt, model, variant } = image;
    return record ? [{ ...record, id, title, alt, model, variant, command: commandOf(image, record.samples) }] : [];
  });
  const models = [...new Set(records.map(({ model }) => model))].filter((model) => !LARGE_MODELS.includes(model));
  writeFileSync(facts, `${JSON.stringify({ images: records, models }, null, 2)}\n`);
  return 0;
}

// The models of the gallery are part of the built site, so that the playground can open them: /images/models/. They are
// not below /gallery/, since servers would look for the page of that address in a folder of its name.
import { execFile } from 'node:child_process';
import { copyFileSync, mkdirSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';

const at = (path: string) => fileURLToPath(new URL(path, import.meta.url));

/** Writes the models that the gallery's page links to into a folder of the site. */
export async function buildGalleryModels(outDir: string): Promise<void> {
  const { images, models } = JSON.parse(readFileSync(at('../gallery.json'), 'utf8')) as {
    readonly images: readonly { readonly id: string; readonly model: string }[];
    readonly models: readonly string[];
  };
  if (models.length === 0) return;
  const ids = models.map((model) => images.find((image) => image.model === model)!.id);
  const folder = mkdtempSync(join(tmpdir(), 'glanz-gallery-'));
  try {
    await promisify(execFile)(
      process.execPath,
      [at('../../../tools/gallery/src/main.mjs'), '--models', '--only', ids.join(','), '--out', folder],
      { maxBuffer: 1 << 24 },
    );
    mkdirSync(outDir, { recursive: true });
    for (const model of models) copyFileSync(join(folder, 'models', `${model}.glb`), join(outDir, `${model}.glb`));
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

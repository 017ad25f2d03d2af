import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { assetFile, decodePixels, glbImages, packPixels, pixelsName } from '../equal-time/load';
import { FILM_WEIGHTS } from '@glanz/denoise/film';
import { HALL, PRODUCT_MODELS, PRODUCT_TEXELS } from './product-scenes';

/**
 * Copies the product scenes' files and two networks into a folder, with all images decoded, so that a bundle beside it
 * needs nothing else. Gives what was not there to copy.
 */
export async function packProducts(folder: string, weights: string): Promise<string[]> {
  const missing: string[] = [];
  const copy = (from: string, to: string) => {
    mkdirSync(dirname(join(folder, to)), { recursive: true });
    copyFileSync(from, join(folder, to));
  };
  mkdirSync(join(folder, 'images'), { recursive: true });
  for (const path of [HALL, ...Object.values(PRODUCT_MODELS).map(({ file }) => file)]) {
    const file = assetFile(path);
    if (!file) {
      missing.push(path);
      continue;
    }
    copy(file, path);
    if (path.endsWith('.glb'))
      for (const image of glbImages(new Uint8Array(readFileSync(file))))
        writeFileSync(
          join(folder, 'images', pixelsName(image)),
          packPixels(await decodePixels(image, { largest: PRODUCT_TEXELS })),
        );
  }
  for (const { color } of [FILM_WEIGHTS.fast, FILM_WEIGHTS.balanced])
    copy(join(weights, `${color}.tza`), `weights/${color}.tza`);
  return missing;
}

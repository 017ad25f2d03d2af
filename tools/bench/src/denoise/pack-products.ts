import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { assetFile, decodePixels, glbImages, packPixels, pixelsName } from '../equal-time/load';
import { FILM_WEIGHTS } from '@glanz/denoise/film';
import { GLASS_TABLE, HALL, PRODUCT_MODELS, PRODUCT_TEXELS } from './product-scenes';

/** Bytes at the beginning of an encoded image that say what it is. */
const KEPT = 64;

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
  for (const path of [HALL, GLASS_TABLE, ...Object.values(PRODUCT_MODELS).map(({ file }) => file)]) {
    const file = assetFile(path);
    if (!file) {
      missing.push(path);
      continue;
    }
    const bytes = new Uint8Array(readFileSync(file));
    if (!path.endsWith('.glb')) {
      copy(file, path);
      continue;
    }
    for (const [i, image] of glbImages(bytes).entries()) {
      const pixels = packPixels(await decodePixels(image, { largest: PRODUCT_TEXELS }));
      // Its pixels are enough: of the encoded image what says its type stays, and what tells it from the others.
      image.fill(0, KEPT);
      image[KEPT] = i;
      writeFileSync(join(folder, 'images', pixelsName(image)), pixels);
    }
    mkdirSync(dirname(join(folder, path)), { recursive: true });
    writeFileSync(join(folder, `${path}.gz`), gzipSync(bytes, { level: 9 }));
  }
  for (const { color } of [FILM_WEIGHTS.fast, FILM_WEIGHTS.balanced])
    copy(join(weights, `${color}.tza`), `weights/${color}.tza`);
  return missing;
}

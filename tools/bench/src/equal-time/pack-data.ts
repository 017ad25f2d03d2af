import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { referenceFolder, GROUND_TRUTH_CASES } from '@glanz/reference';
import { assetFile, decodePixels, glbImages, packPixels, pixelsName } from './load';
import { HELMET_FILES } from './scenes';

/** Files of a scene of the reference set that a measurement reads: of the references, not those of other microfacet models. */
const PACKED = /^(scene\.(json|glb)|env\.hdr|ref(\.(?!sep\b)\w+)*\.(exr|f32|stats\.json))$/;

function copy(from: string, to: string): void {
  mkdirSync(dirname(to), { recursive: true });
  copyFileSync(from, to);
}

/**
 * Copies what the benchmark reads into a folder, with all images decoded, so that a bundle beside it needs nothing
 * else. Gives what was not there to copy.
 */
export async function packData(folder: string): Promise<string[]> {
  const missing: string[] = [];
  const models: string[] = [];
  const references = referenceFolder();
  for (const name of new Set(GROUND_TRUTH_CASES.map(({ scene }) => scene))) {
    if (!references || !existsSync(join(references, name))) {
      missing.push(name);
      continue;
    }
    for (const file of readdirSync(join(references, name)).filter((entry) => PACKED.test(entry)))
      copy(join(references, name, file), join(folder, 'groundtruth', name, file));
    models.push(join(references, name, 'scene.glb'));
  }
  if (references) copy(join(references, 'tolerances.json'), join(folder, 'groundtruth', 'tolerances.json'));
  for (const path of Object.values(HELMET_FILES)) {
    const file = assetFile(path);
    if (!file) missing.push(path);
    else {
      copy(file, join(folder, 'assets', path));
      if (path.endsWith('.glb')) models.push(file);
    }
  }
  mkdirSync(join(folder, 'images'), { recursive: true });
  for (const model of models) {
    for (const image of glbImages(new Uint8Array(readFileSync(model))))
      writeFileSync(join(folder, 'images', pixelsName(image)), packPixels(await decodePixels(image)));
  }
  return missing;
}

import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Scene } from '@glanz/scene';
import { createCornellBox, createPushButton } from './index';
import { GALLERY_MODELS } from './gallery-models';
import { sceneToGlb } from './to-gltf';

const MODELS: Readonly<Record<string, () => Scene>> = {
  'push-button-high': () => createPushButton({ level: 'high' }),
  'push-button-medium': () => createPushButton({ level: 'medium' }),
  'push-button-low': () => createPushButton({ level: 'low' }),
  'cornell-box': createCornellBox,
  ...GALLERY_MODELS,
};

/** Writes the named models, or all of them, as .glb files. Gives the exit code. */
export async function writeModels(folder: string, names: readonly string[]): Promise<number> {
  const requested = names.length > 0 ? names : Object.keys(MODELS);
  for (const name of requested) {
    const make = MODELS[name];
    if (!make) {
      process.stderr.write(`There is no model "${name}"; models: ${Object.keys(MODELS).join(', ')}.\n`);
      return 1;
    }
    const scene = make();
    const bytes = await sceneToGlb(scene);
    const file = join(folder, `${name}.glb`);
    mkdirSync(folder, { recursive: true });
    writeFileSync(file, bytes);
    const triangles = scene.meshes.reduce((sum, mesh) => sum + mesh.indices.length / 3, 0);
    process.stdout.write(
      `${file}: ${triangles} triangles, ${scene.instances.length} parts, ${(bytes.byteLength / 2 ** 20).toFixed(1)} MiB\n`,
    );
  }
  return 0;
}

import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { isModelFile, loadModelFile } from '@glanz/formats/node';
import { loadGltfFile } from '@glanz/gltf/node';
import { frameCamera } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';
import { assetFile } from '../equal-time/load';
import type { HashCase } from './scenes';

/** The sample assets as scenes under the studio environment; `undefined` where their folder is not present. */
export function assetCases(): HashCase[] | undefined {
  const index = assetFile('index.json');
  if (index === undefined) return undefined;
  const assets = JSON.parse(readFileSync(index, 'utf8')) as readonly { readonly name: string; readonly main: string }[];
  const environment = studioEnvironment();
  return assets
    .filter(({ main }) => /\.(glb|gltf|obj|stl)$/i.test(main))
    .map(({ name, main }) => ({
      name: `asset ${name}`,
      scene: async () => {
        const file = join(dirname(index), main);
        const scene = isModelFile(file) ? await loadModelFile(file) : await loadGltfFile(file);
        return {
          ...scene,
          environment: scene.environment ?? environment,
          cameras: [frameCamera(scene, { aspect: 1 })],
        };
      },
    }));
}

// Writes the sample model of the quick starts, push-button.glb: made by this repository's own tools, so that a page can
// show something before its author has a model.
import { mkdir, writeFile } from 'node:fs/promises';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { build } from 'esbuild';

/** @param {string} folder The package's. @param {string} file Where the model goes. */
export async function writeSample(folder, file) {
  const models = resolve(folder, '../../tools/models');
  // Inside of that package, so that what it depends on is found.
  const outfile = join(models, 'node_modules', '.cache', `sample-${process.pid}.mjs`);
  const contents = "export { createPushButton } from './src/index'; export { sceneToGlb } from './src/to-gltf';";
  const bundled = await build({
    stdin: { contents, resolveDir: models, loader: 'ts' },
    bundle: true,
    platform: 'node',
    format: 'esm',
    conditions: ['@glanz/source'],
    external: ['@gltf-transform/*', 'sharp'],
    write: false,
  });
  await mkdir(join(models, 'node_modules', '.cache'), { recursive: true });
  await writeFile(outfile, bundled.outputFiles[0].contents);
  const { createPushButton, sceneToGlb } = await import(pathToFileURL(outfile).href);
  await writeFile(file, await sceneToGlb(createPushButton({ level: 'low' })));
}

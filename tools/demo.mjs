// npm run demo — makes the push-button, path-traces it and writes out/demo.png, denoised, and out/demo-film.png, the same
// samples without denoising: on a real GPU in full, without one on the processor, smaller and with fewer samples.
// Arguments after -- go to glanz render.
import { existsSync, rmSync } from 'node:fs';
import { join, relative } from 'node:path';
import { TaskError, capture, main, root, stream } from './pipeline/process.mjs';

const glanz = join(root, 'packages/cli/dist/glanz.js');
const model = join(root, 'out/models/push-button-medium.glb');
const image = join(root, 'out/demo.png');
const filmImage = join(root, 'out/demo-film.png');
const film = join(root, 'out/demo.film');

/** True if something better than the processor is there. */
async function hasRealGpu() {
  const { output } = await capture(process.execPath, [glanz, '--list-gpus', '--json']);
  try {
    const line = output.split('\n').find((text) => text.startsWith('{'));
    return JSON.parse(line ?? '{}').gpus?.some((gpu) => !gpu.software) ?? false;
  } catch {
    return false;
  }
}

await main(async () => {
  const start = performance.now();
  if (!existsSync(model)) {
    const code = await stream(process.execPath, [join(root, 'tools/models/write.mjs'), 'push-button-medium']);
    if (code !== 0) throw new TaskError(`the model could not be written (code ${code}).`);
  }
  const settings = (await hasRealGpu())
    ? ['--size', '1280x960', '--samples', '256', '--denoise', 'balanced']
    : ['--size', '640x480', '--samples', '12', '--denoise', 'fast'];
  for (const file of [image, filmImage, film]) rmSync(file, { force: true });
  const outputs = ['-o', image, '-o', film];
  const code = await stream(process.execPath, [
    glanz,
    'render',
    model,
    ...outputs,
    ...settings,
    ...process.argv.slice(2),
  ]);
  if (!existsSync(image)) throw new TaskError(`no image was made (glanz ended with code ${code}).`, code || 1);
  const elapsed = Math.round((performance.now() - start) / 1000);
  if (existsSync(film)) await stream(process.execPath, [glanz, 'merge', film, '-o', filmImage, '--quiet']);
  const name = (file) => relative(process.cwd(), file);
  process.stderr.write(`\n${name(image)} is done, after ${elapsed} s, denoised; ${name(filmImage)} is not denoised.\n`);
  process.stderr.write(
    'Next: npm start opens the playground, where you drop a .glb of your own; npm run glanz -- --help describes the command.\n',
  );
  return code;
});

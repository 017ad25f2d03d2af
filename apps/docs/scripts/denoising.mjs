// node apps/docs/scripts/denoising.mjs [name …] — path-traces what the page about denoising compares, with the command
// line of this repository, into public/denoising/: a push-button with 1, 4, 16 and 64 samples (1, 4, 16, 64), as it is
// and denoised, and one with 256 other samples (reference). Needs a build (npm run build).
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import sharp from 'sharp';

const REFERENCE_SAMPLES = 256;

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
const [out, model] = [at('../public/denoising'), at('../../../out/models/push-button-medium.glb')];
const folder = mkdtempSync(join(tmpdir(), 'glanz-denoising-'));
const run = (script, ...args) => execFileSync(process.execPath, [script, ...args], { stdio: 'inherit' });
const glanz = (...args) => run(at('../../../packages/cli/dist/glanz.js'), ...args);

/** What is interrupted continues from its checkpoint. */
function render(name, ...args) {
  const checkpoint = join(tmpdir(), `glanz-denoising-${name}.film`);
  glanz('render', model, '--size', '528x396', '--checkpoint', checkpoint, ...args);
}

async function write(file, name) {
  const image = join(out, `${name}.webp`);
  await sharp(file).webp({ quality: 88 }).toFile(image);
  process.stderr.write(`${image}: ${(statSync(image).size / 1000).toFixed(0)} kB\n`);
}

/** The same samples as an image and as one that is denoised. */
async function pair(samples) {
  const [film, file] = [join(folder, `${samples}.film`), join(folder, `${samples}.png`)];
  render(samples, '--samples', samples, '--denoise', 'fast', '-o', film, '-o', file);
  await write(file, `${samples}-denoised`);
  glanz('merge', film, '-o', file);
  await write(file, samples);
}

async function reference() {
  const file = join(folder, 'reference.png');
  render('reference', '--samples', `${REFERENCE_SAMPLES}`, '--seed', '1', '-o', file);
  await write(file, 'reference');
}

mkdirSync(out, { recursive: true });
try {
  run(at('../../../tools/models/write.mjs'), 'push-button-medium');
  const [, , ...names] = process.argv;
  for (const name of names.length > 0 ? names : ['1', '4', '16', '64', 'reference'])
    await (name === 'reference' ? reference() : pair(name));
} finally {
  rmSync(folder, { recursive: true, force: true });
}

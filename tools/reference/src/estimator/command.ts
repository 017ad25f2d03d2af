import { parseArgs } from 'node:util';
import { estimate } from './estimate';
import { imageMean, writeGlassReference } from './glass-reference';
import { GLASS_SCENES, glassScene, type GlassSceneName } from './glass-scenes';

const HELP = `npm run reference -- [NAME…] [--samples N] [--seed N] [--out FOLDER]

Estimates the references of the glass scenes (${GLASS_SCENES.join(', ')}; default all) by brute force on the CPU, up to
a minute each, and writes them into tools/reference/glass or FOLDER. Defaults: 256 samples per pixel, seed 1.
`;

/** The command `npm run reference`. @returns The exit code. */
export function referenceCommand(args: readonly string[]): number {
  const { values, positionals } = parseArgs({
    args: [...args],
    allowPositionals: true,
    options: {
      samples: { type: 'string', default: '256' },
      seed: { type: 'string', default: '1' },
      out: { type: 'string' },
      help: { type: 'boolean', default: false },
    },
  });
  if (values.help) {
    process.stdout.write(HELP);
    return 0;
  }
  const [samples, seed] = [Number(values.samples), Number(values.seed)];
  const known = (name: string): name is GlassSceneName => (GLASS_SCENES as readonly string[]).includes(name);
  const unknown = positionals.find((name) => !known(name));
  if (unknown !== undefined || !(Number.isInteger(samples) && samples >= 2) || !(Number.isInteger(seed) && seed >= 0)) {
    process.stderr.write(unknown === undefined ? HELP : `There is no scene "${unknown}".\n${HELP}`);
    return 1;
  }
  for (const name of positionals.length > 0 ? positionals.filter(known) : GLASS_SCENES) {
    const { scene, width, height, maxDepth } = glassScene(name);
    const start = performance.now();
    const onRow = (rows: number) =>
      process.stderr.isTTY && process.stderr.write(`\r${name}: ${Math.round((100 * rows) / height)} %`);
    const image = estimate(scene, { width, height, samples, maxDepth, seed, onRow });
    const command = `npm run reference -- ${name} --samples ${samples} --seed ${seed}`;
    writeGlassReference(name, image, { width, height }, { samples, seed, maxDepth, command }, values.out);
    const { mean, standardError } = imageMean(image);
    const seconds = ((performance.now() - start) / 1000).toFixed(0);
    const figures = mean.map((value, k) => `${value.toFixed(5)} ± ${standardError[k]!.toFixed(5)}`).join(', ');
    process.stderr.write(`${process.stderr.isTTY ? '\r' : ''}${name}: ${figures}; ${seconds} s\n`);
  }
  return 0;
}

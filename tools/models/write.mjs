// node tools/models/write.mjs [name …] — writes the procedural models as out/models/<name>.glb.
import { mkdirSync } from 'node:fs';
import { join, relative } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';

const here = fileURLToPath(new URL('.', import.meta.url));
const outfile = join(here, '.cache', 'write.mjs');
mkdirSync(join(here, '.cache'), { recursive: true });
await build({
  entryPoints: [join(here, 'src/write.ts')],
  outfile,
  bundle: true,
  platform: 'node',
  format: 'esm',
  target: 'node20',
  conditions: ['@glanz/source'],
  logLevel: 'error',
});
const { writeModels } = await import(pathToFileURL(outfile).href);
process.exitCode = await writeModels(relative('.', join(here, '../../out/models')), process.argv.slice(2));

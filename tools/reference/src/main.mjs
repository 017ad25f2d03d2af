// npm run reference — bundles the tool from the sources of the workspace, then runs it in this process.
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';

const folder = dirname(fileURLToPath(import.meta.url));
const outfile = join(folder, '../.cache/reference.mjs');
await build({
  entryPoints: [join(folder, 'estimator/command.ts')],
  outfile,
  bundle: true,
  platform: 'node',
  format: 'esm',
  target: 'node20',
  conditions: ['@glanz/source'],
  logLevel: 'error',
});
const { referenceCommand } = await import(pathToFileURL(outfile).href);
process.exitCode = referenceCommand(process.argv.slice(2));

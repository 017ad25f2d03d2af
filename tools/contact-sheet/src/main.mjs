// npm run contact-sheet — bundles the tool from the sources of the workspace, then runs it.
import { mkdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';
import { weslSource } from '../../pipeline/wesl.mjs';

const folder = dirname(fileURLToPath(import.meta.url));
const outfile = join(folder, '../.cache/contact-sheet.mjs');
mkdirSync(dirname(outfile), { recursive: true });
await build({
  entryPoints: [join(folder, 'contact-sheet.ts')],
  outfile,
  bundle: true,
  platform: 'node',
  format: 'esm',
  target: 'node20',
  conditions: ['@glanz/source'],
  external: ['webgpu', 'sharp', 'draco3dgltf', 'meshoptimizer', 'three', '@sparticuz/chromium'],
  banner: {
    js: "import { createRequire as __createRequire } from 'node:module'; const require = __createRequire(import.meta.url);",
  },
  plugins: [weslSource()],
  logLevel: 'error',
});
const { contactSheet } = await import(pathToFileURL(outfile).href);
process.exitCode = await contactSheet(process.argv.slice(2));

// Path-traces the images of the section "How it works" into public/how/:
//   node apps/docs/scripts/how.mjs [name …]
import { mkdirSync, mkdtempSync, readdirSync, rmSync } from 'node:fs';
import { basename, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';
import { weslSource } from '../../../tools/pipeline/wesl.mjs';
import sharp from 'sharp';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));

mkdirSync(at('../.vitepress/cache'), { recursive: true });
mkdirSync(at('../public/how'), { recursive: true });
const folder = mkdtempSync(at('../.vitepress/cache/how-'));
try {
  // Bundled from the sources; what is native stays outside.
  await build({
    stdin: { contents: "export * from './how-images';\n", resolveDir: at('../src'), loader: 'ts' },
    outfile: join(folder, 'how.mjs'),
    conditions: ['@glanz/source'],
    bundle: true,
    format: 'esm',
    platform: 'node',
    target: 'node20',
    plugins: [weslSource()],
    external: ['webgpu', '@sparticuz/chromium'],
  });
  const { howMain } = await import(pathToFileURL(join(folder, 'how.mjs')).href);
  await howMain([folder, ...process.argv.slice(2)]);
  // Noise is what they show: nothing may be smoothed away.
  for (const file of readdirSync(folder).filter((name) => name.endsWith('.png')))
    await sharp(join(folder, file))
      .webp({ lossless: true, effort: 6 })
      .toFile(at(`../public/how/${basename(file, '.png')}.webp`));
} finally {
  rmSync(folder, { recursive: true, force: true });
}

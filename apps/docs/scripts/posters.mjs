// node apps/docs/scripts/posters.mjs [samples] [name …] — path-traces what live images show until a visitor starts
// them, into public/posters/.
import { mkdirSync, mkdtempSync, rmSync, statSync } from 'node:fs';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';
import { weslSource } from '../../../tools/pipeline/wesl.mjs';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
mkdirSync(at('../.vitepress/cache'), { recursive: true });
mkdirSync(at('../public/posters'), { recursive: true });
const folder = mkdtempSync(at('../.vitepress/cache/posters-'));
try {
  // Bundled from the sources; what is native stays outside.
  await build({
    entryPoints: [at('../src/posters.ts')],
    outfile: `${folder}/posters.mjs`,
    conditions: ['@glanz/source'],
    bundle: true,
    format: 'esm',
    platform: 'node',
    plugins: [weslSource()],
    external: ['webgpu', '@sparticuz/chromium'],
  });
  const { renderPosters } = await import(pathToFileURL(`${folder}/posters.mjs`).href);
  const { default: sharp } = await import('sharp');
  const [samples = '96', ...names] = process.argv.slice(2);
  for await (const { name, width, height, data } of renderPosters({
    samples: Number(samples),
    names,
    report: (line) => process.stderr.write(`${line}\n`),
  })) {
    const out = at(`../public/posters/${name}.webp`);
    await sharp(data, { raw: { width, height, channels: 4 } })
      .removeAlpha()
      .webp({ quality: 80 })
      .toFile(out);
    process.stderr.write(`${out}: ${(statSync(out).size / 1024).toFixed(0)} KB\n`);
  }
} finally {
  rmSync(folder, { recursive: true, force: true });
}

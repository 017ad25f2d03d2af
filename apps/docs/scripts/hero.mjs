// node apps/docs/scripts/hero.mjs [samples] — path-traces the home page's image into public/push-button.webp.
import { mkdirSync, mkdtempSync, rmSync, statSync } from 'node:fs';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';
import { weslSource } from '../../../tools/pipeline/wesl.mjs';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
mkdirSync(at('../.vitepress/cache'), { recursive: true });
const folder = mkdtempSync(at('../.vitepress/cache/hero-'));
try {
  // Bundled from the sources; what is native stays outside.
  await build({
    entryPoints: [at('../src/hero.ts')],
    outfile: `${folder}/hero.mjs`,
    conditions: ['@glanz/source'],
    bundle: true,
    format: 'esm',
    platform: 'node',
    plugins: [weslSource()],
    external: ['webgpu', '@sparticuz/chromium'],
  });
  const { renderHero } = await import(pathToFileURL(`${folder}/hero.mjs`).href);
  const { width, height, data } = await renderHero({
    samples: Number(process.argv[2] ?? 256),
    report: (line) => process.stderr.write(`${line}\n`),
  });
  const { default: sharp } = await import('sharp');
  const out = at('../public/push-button.webp');
  await sharp(data, { raw: { width, height, channels: 4 } })
    .resize(width / 2, height / 2)
    .webp({ quality: 86, alphaQuality: 90 })
    .toFile(out);
  process.stderr.write(`${out}: ${(statSync(out).size / 1024).toFixed(0)} KB\n`);
} finally {
  rmSync(folder, { recursive: true, force: true });
}

// node apps/docs/scripts/presets.mjs [samples] [name …] — path-traces a picture of each preset into public/presets/.
import { mkdirSync, mkdtempSync, rmSync, statSync } from 'node:fs';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
const [samples = '256', ...names] = process.argv.slice(2);
mkdirSync(at('../.vitepress/cache'), { recursive: true });
mkdirSync(at('../public/presets'), { recursive: true });
const folder = mkdtempSync(at('../.vitepress/cache/presets-'));
try {
  // Bundled from the sources; what is native stays outside.
  await build({
    entryPoints: [at('../src/preset-pictures.ts')],
    outfile: `${folder}/presets.mjs`,
    conditions: ['@glanz/source'],
    bundle: true,
    format: 'esm',
    platform: 'node',
    external: ['webgpu', '@sparticuz/chromium'],
  });
  const { renderPresets } = await import(pathToFileURL(`${folder}/presets.mjs`).href);
  const { default: sharp } = await import('sharp');
  for await (const { name, size, data } of renderPresets({ size: 320, samples: Number(samples), ...(names.length > 0 ? { names } : {}) })) {
    const out = at(`../public/presets/${name}.webp`);
    await sharp(data, { raw: { width: size, height: size, channels: 4 } }).resize(size / 2, size / 2).removeAlpha().webp({ quality: 82 }).toFile(out);
    process.stderr.write(`${name}: ${(statSync(out).size / 1024).toFixed(1)} KB\n`);
  }
} finally {
  rmSync(folder, { recursive: true, force: true });
}

// Path-traces an image of each preset into public/presets/:
//   node apps/docs/scripts/presets.mjs [--samples N] [name …]
// or in two steps, for a machine that has a GPU and nothing else (see tools/gpu/pack.sh):
//   node apps/docs/scripts/presets.mjs --pack .gpu-bench/presets.mjs          here
//   . .gpu/setup.sh && $GPU_NODE .gpu-bench/presets.mjs FOLDER [N] [name …]   there: PNG files into FOLDER
//   node apps/docs/scripts/presets.mjs --from FOLDER                          here again
import { mkdirSync, mkdtempSync, readdirSync, rmSync, statSync } from 'node:fs';
import { basename, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import { build } from 'esbuild';
import { weslSource } from '../../../tools/pipeline/wesl.mjs';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
const { values, positionals: names } = parseArgs({
  allowPositionals: true,
  options: { samples: { type: 'string', default: '256' }, pack: { type: 'string' }, from: { type: 'string' } },
});

/** Bundled from the sources; what is native stays outside. */
const pack = (contents, outfile) =>
  build({
    stdin: { contents, resolveDir: at('../src'), loader: 'ts' },
    outfile,
    conditions: ['@glanz/source'],
    bundle: true,
    format: 'esm',
    platform: 'node',
    target: 'node20',
    plugins: [weslSource()],
    external: ['webgpu', '@sparticuz/chromium'],
  });

async function convert(folder) {
  const { default: sharp } = await import('sharp');
  mkdirSync(at('../public/presets'), { recursive: true });
  let total = 0;
  for (const file of readdirSync(folder).filter((name) => name.endsWith('.png'))) {
    const out = at(`../public/presets/${basename(file, '.png')}.webp`);
    const { width } = await sharp(join(folder, file)).metadata();
    await sharp(join(folder, file))
      .resize(Math.round(width / 2))
      .removeAlpha()
      .webp({ quality: 82 })
      .toFile(out);
    total += statSync(out).size;
  }
  process.stderr.write(`public/presets: ${(total / 1024).toFixed(0)} KB\n`);
}

if (values.pack)
  await pack(
    "import { presetsMain } from './preset-images';\nawait presetsMain(process.argv.slice(2));\n",
    values.pack,
  );
else if (values.from) await convert(values.from);
else {
  mkdirSync(at('../.vitepress/cache'), { recursive: true });
  const folder = mkdtempSync(at('../.vitepress/cache/presets-'));
  try {
    await pack("export * from './preset-images';\n", join(folder, 'presets.mjs'));
    const { presetsMain } = await import(pathToFileURL(join(folder, 'presets.mjs')).href);
    await presetsMain([folder, values.samples, ...names]);
    await convert(folder);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

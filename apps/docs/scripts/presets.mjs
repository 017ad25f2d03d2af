// Path-traces an image of each preset into public/presets/:
//   node apps/docs/scripts/presets.mjs [--samples N] [name …]
// or in two steps, for a machine that has a GPU and nothing else (see tools/gpu/pack.sh):
//   node apps/docs/scripts/presets.mjs --pack .gpu-bench/presets.mjs          here
//   . .gpu/setup.sh && $GPU_NODE .gpu-bench/presets.mjs FOLDER [N] [name …]   there: PNG files into FOLDER
//   node apps/docs/scripts/presets.mjs --from FOLDER                          here again
import { mkdirSync, readdirSync, statSync } from 'node:fs';
import { basename, join } from 'node:path';
import { parseArgs } from 'node:util';
import { at, bundleSources, withSources } from './sources.mjs';

const { values, positionals: names } = parseArgs({
  allowPositionals: true,
  options: { samples: { type: 'string', default: '256' }, pack: { type: 'string' }, from: { type: 'string' } },
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
  await bundleSources(
    "import { presetsMain } from './preset-images';\nawait presetsMain(process.argv.slice(2));\n",
    values.pack,
  );
else if (values.from) await convert(values.from);
else
  await withSources('preset-images', async ({ presetsMain }, folder) => {
    await presetsMain([folder, values.samples, ...names]);
    await convert(folder);
  });

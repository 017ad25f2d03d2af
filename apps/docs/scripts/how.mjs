// Path-traces the images of the section "How it works" into public/how/:
//   node apps/docs/scripts/how.mjs [name …]
import { mkdirSync, readdirSync } from 'node:fs';
import { basename, join } from 'node:path';
import sharp from 'sharp';
import { at, withSources } from './sources.mjs';

mkdirSync(at('../public/how'), { recursive: true });
await withSources('how-images', async ({ howMain }, folder) => {
  await howMain([folder, ...process.argv.slice(2)]);
  // Noise is what they show: nothing may be smoothed away.
  for (const file of readdirSync(folder).filter((name) => name.endsWith('.png')))
    await sharp(join(folder, file))
      .webp({ lossless: true, effort: 6 })
      .toFile(at(`../public/how/${basename(file, '.png')}.webp`));
});

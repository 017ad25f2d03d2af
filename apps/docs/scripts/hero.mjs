// node apps/docs/scripts/hero.mjs [samples] — path-traces public/push-button.webp, which the playground's list of samples shows.
import { statSync } from 'node:fs';
import sharp from 'sharp';
import { at, withSources } from './sources.mjs';

await withSources('hero', async ({ renderHero }) => {
  const { width, height, data } = await renderHero({
    samples: Number(process.argv[2] ?? 256),
    report: (line) => process.stderr.write(`${line}\n`),
  });
  const out = at('../public/push-button.webp');
  await sharp(data, { raw: { width, height, channels: 4 } })
    .resize(width / 2, height / 2)
    .webp({ quality: 86, alphaQuality: 90 })
    .toFile(out);
  process.stderr.write(`${out}: ${(statSync(out).size / 1024).toFixed(0)} KB\n`);
});

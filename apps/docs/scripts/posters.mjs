// node apps/docs/scripts/posters.mjs [samples] [name …] — path-traces what live images show until a visitor starts
// them, into public/posters/.
import { mkdirSync, statSync } from 'node:fs';
import sharp from 'sharp';
import { at, withSources } from './sources.mjs';

mkdirSync(at('../public/posters'), { recursive: true });
await withSources('posters', async ({ renderPosters }) => {
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
});

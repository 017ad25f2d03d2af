// npm run rasterised (in apps/docs), or node apps/docs/scripts/rasterised.mjs — what the pages compare as "rasterised"
// with an image of the gallery: its .glb, camera and tone map in three.js in Chromium, into public/rasterised/.
// `npm run gallery -- --only tumbler-whisky` renders the other side.
import { mkdirSync, statSync } from 'node:fs';
import sharp from 'sharp';
import { at, withSources } from './sources.mjs';

/** By the name of the image in the gallery. */
const IMAGES = { 'tumbler-whisky': { model: 'tumbler', camera: 'Front', at: [0, 0.05, 0], width: 1600, height: 1000 } };

mkdirSync(at('../public/rasterised'), { recursive: true });
await withSources('rasterised', async ({ rasterise }) => {
  for (const [name, image] of Object.entries(IMAGES)) {
    const png = await rasterise(image, { docs: at('..'), browser: at('../../../.cache/browser') });
    const out = at(`../public/rasterised/${name}.webp`);
    await sharp(png).removeAlpha().webp({ quality: 86 }).toFile(out);
    process.stderr.write(`${out}: ${(statSync(out).size / 1000).toFixed(0)} kB\n`);
  }
});

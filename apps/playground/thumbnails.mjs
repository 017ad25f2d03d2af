// node apps/playground/thumbnails.mjs — writes the small images of looks and samples (src/images), rendered by the built
// playground itself on the software GPU. Those of the gallery's models are reduced from the documentation's images.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { chromium } from '@playwright/test';
import { build } from 'esbuild';
import { preview } from 'vite';

const here = fileURLToPath(new URL('.', import.meta.url));
const root = join(here, '../..');
const [WIDTH, HEIGHT, QUALITY] = [216, 144, 0.85];
const only = process.argv.slice(2);

/** How the tests start Chromium. */
async function launch() {
  const outfile = join(root, '.cache/launch.mjs');
  await build({
    entryPoints: [join(root, 'tools/browser/src/launch.ts')],
    outfile,
    bundle: true,
    platform: 'node',
    format: 'esm',
    packages: 'external',
    logLevel: 'error',
  });
  const { launchOptions } = await import(pathToFileURL(outfile).href);
  return chromium.launch(await launchOptions(join(root, '.cache/browser')));
}

/** An image file in the size and format of a thumbnail, its middle where the shape differs. */
const reduced = async (page, bytes, type) =>
  Buffer.from(
    await page.evaluate(
      async ([base64, mime, width, height, quality]) => {
        const blob = await (await fetch(`data:${mime};base64,${base64}`)).blob();
        const image = await createImageBitmap(blob);
        const scale = Math.max(width / image.width, height / image.height);
        const [w, h] = [width / scale, height / scale];
        const small = await createImageBitmap(image, (image.width - w) / 2, (image.height - h) / 2, w, h, {
          resizeWidth: width,
          resizeHeight: height,
          resizeQuality: 'high',
        });
        const canvas = new OffscreenCanvas(width, height);
        canvas.getContext('2d').drawImage(small, 0, 0);
        const out = new Uint8Array(await (await canvas.convertToBlob({ type: 'image/webp', quality })).arrayBuffer());
        return btoa(Array.from(out, (byte) => String.fromCharCode(byte)).join(''));
      },
      [bytes.toString('base64'), type, WIDTH, HEIGHT, QUALITY],
    ),
    'base64',
  );

const finished = (page) =>
  page.waitForFunction(() => document.querySelector('#image')?.getAttribute('data-state') === 'done', undefined, {
    timeout: 900_000,
    polling: 500,
  });

function write(kind, name, bytes) {
  const folder = join(here, 'src/images', kind);
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(folder, `${name}.webp`), bytes);
  process.stdout.write(`${kind}/${name}.webp, ${bytes.length} bytes\n`);
}

const server = await preview({ root: here, preview: { port: 0, open: false }, logLevel: 'error' });
const origin = server.resolvedUrls.local[0];
const browser = await launch();
try {
  // The stage is 432 × 288 pixels.
  const page = await browser.newPage({ viewport: { width: 772, height: 339 } });
  const photograph = async () =>
    reduced(
      page,
      await page.locator('#image').screenshot({
        style: '.status, .messages, .tools, .menu, #outline { visibility: hidden } #image { outline: none !important }',
      }),
      'image/png',
    );
  const asked = (kind) => only.length === 0 || only.includes(kind);
  if (asked('looks')) {
    await page.goto(`${origin}?model=push-button&samples=24&max-depth=5&scale=0.5`);
    await page.locator('body[data-panels=ready]').waitFor({ timeout: 300_000 });
    await page.locator('#looks').click();
    await page.locator('[data-look]').first().waitFor();
    for (const button of await page.locator('[data-look]').all()) {
      await button.click();
      // The edit restarts the film by the next frames.
      await page.waitForTimeout(1500);
      await finished(page);
      await page.waitForTimeout(500);
      write('looks', await button.getAttribute('data-look'), await photograph());
    }
  }
  if (asked('samples')) {
    await page.goto(`${origin}?model=cornell-box&samples=48&max-depth=6&scale=0.5`);
    await finished(page);
    await page.waitForTimeout(500);
    write('samples', 'cornell-box', await photograph());
    const images = join(root, 'apps/docs/public');
    const sources = readFileSync(join(here, 'src/input/samples.ts'), 'utf8');
    write('samples', 'push-button', await reduced(page, readFileSync(join(images, 'push-button.webp')), 'image/webp'));
    const { images: gallery } = JSON.parse(readFileSync(join(root, 'apps/docs/gallery.json'), 'utf8'));
    for (const [model, id] of new Map(gallery.map(({ model, id }) => [model, id]).reverse()))
      if (sources.includes(`'${model}'`))
        write('samples', model, await reduced(page, readFileSync(join(images, `images/${id}.webp`)), 'image/webp'));
  }
} finally {
  await browser.close();
  await server.close();
}

import { fileURLToPath } from 'node:url';
import { watch, type Served } from '@glanz/browser';
import { test } from '@glanz/browser/shared-device';
import { expect, type Page } from '@playwright/test';
import { build, type BuildOptions } from 'esbuild';
import { weslSource } from '../../../tools/pipeline/wesl.mjs';
import { done, FAST, heard, model, open, put, serveStrictly, shot, viewer } from './open';

let served: Served;
test.beforeAll(async ({ deviceHost }) => {
  served = await serveStrictly();
  deviceHost.origin = served.origin;
});
test.afterAll(() => served.close());
test.use({ viewport: { width: 640, height: 480 } });

let complaints: string[] = [];
test.beforeEach(async ({ page }) => {
  complaints = watch(page, served.origin);
  await page.route('**/*.glb', (route) => route.fulfill({ body: model }));
});
test.afterEach(() => expect(complaints).toEqual([]));

async function bundled(options: BuildOptions): Promise<Buffer> {
  const {
    outputFiles: [module],
  } = await build({
    bundle: true,
    format: 'esm',
    target: 'es2022',
    conditions: ['@glanz/source'],
    plugins: [weslSource()],
    ...options,
    write: false,
  });
  return Buffer.from(module!.contents);
}

/** A module whose images are grey: what a network takes to compile says nothing of how it is loaded. */
const GREY = `import { denoising } from '@glanz/viewer/denoise';
export default denoising(async (device) => ({
  denoiseTracer: async ({ width, height }) => {
    const buffer = device.createBuffer({ size: 16 * width * height, usage: 0x80, mappedAtCreation: true });
    new Float32Array(buffer.getMappedRange()).fill(0.18);
    buffer.unmap();
    return { buffer, width, height };
  },
  read: async ({ width, height }) => new Float32Array(4 * width * height).fill(0.18),
  destroy: () => undefined,
}));`;

/** Serves the guide's module that denoises, with its weights beside it; those in the folder `damaged` are not weights. */
async function serveDenoiser(page: Page): Promise<void> {
  const example = fileURLToPath(new URL('../../../apps/docs/examples/denoise-module.ts', import.meta.url));
  const module = await bundled({ entryPoints: [example] });
  await page.route('**/denoise.js', (route) => route.fulfill({ contentType: 'text/javascript', body: module }));
  const weights = fileURLToPath(new URL('../../denoise-weights/weights/', import.meta.url));
  await page.route('**/*.tza', (route) => {
    const { pathname } = new URL(route.request().url());
    return pathname.includes('damaged')
      ? route.fulfill({ body: Buffer.from('no weights') })
      : route.fulfill({ path: weights + pathname.slice(1) });
  });
}

/**
 * Whether the frame that follows a change of the exposure, which is of no concern to a denoiser, shows it.
 * No frame follows an exposure that the element has already.
 */
const showsDenoised = (page: Page, exposure: number) =>
  page.evaluate(
    (value) =>
      new Promise<boolean>((resolve) => {
        const element = document.querySelector('glanz-viewer')!;
        element.viewer!.on('frame', ({ denoised }) => resolve(denoised));
        element.exposureEv = value;
      }),
    exposure,
  );

/** Waits until frames show the denoiser. */
async function becomesDenoised(page: Page): Promise<void> {
  let exposure = 1;
  await expect.poll(() => showsDenoised(page, (exposure += 1 / 64))).toBe(true);
}

const setDenoise = (page: Page, address: string | null) =>
  page.evaluate((value) => void (document.querySelector('glanz-viewer')!.denoise = value), address);

test('images are denoised by the module that `denoise` names, and say so', async ({ page }) => {
  await serveDenoiser(page);
  await open(page, served.origin, { denoise: 'denoise.js', samples: '2' });
  await becomesDenoised(page);
  expect(await showsDenoised(page, 0.5)).toBe(true);
  const saved = () =>
    page.evaluate(async () =>
      new TextDecoder('latin1').decode(await (await document.querySelector('glanz-viewer')!.toBlob()).arrayBuffer()),
    );
  expect(await saved()).toContain('tEXtDenoised');
  const clean = await shot(page);

  // Without it the film is shown, which is that of an element that has never had one.
  await setDenoise(page, null);
  expect(await showsDenoised(page, 0.25)).toBe(false);
  expect(await showsDenoised(page, 0.5)).toBe(false);
  expect(await saved()).not.toContain('tEXtDenoised');
  const film = await shot(page);
  expect(film.cells).not.toEqual(clean.cells);
  await page.evaluate(() => document.querySelector('glanz-viewer')!.remove());
  await put(page, { src: 'model.glb', alt: 'Two cards', ...FAST, samples: '2', 'exposure-ev': '0.5' });
  await done(page);
  expect((await shot(page)).cells).toEqual(film.cells);
  expect(await heard(page, 'warning')).toEqual([]);
  expect(await heard(page, 'error')).toEqual([]);
});

test('a denoiser that does not load is a warning, and the image is there with its noise', async ({ page }) => {
  await serveDenoiser(page);
  await page.route('**/none.js', (route) => route.fulfill({ status: 404 }));
  const grey = await bundled({ stdin: { contents: GREY, resolveDir: fileURLToPath(new URL('.', import.meta.url)) } });
  await page.route('**/grey.js', (route) => route.fulfill({ contentType: 'text/javascript', body: grey }));
  await page.route('**/other.js', (route) =>
    route.fulfill({ contentType: 'text/javascript', body: 'export default { denoise: true };' }),
  );
  await open(page, served.origin, { denoise: 'none.js' });
  const warnings = () => heard(page, 'warning');
  await expect.poll(warnings).toHaveLength(1);
  await setDenoise(page, 'other.js');
  await expect.poll(warnings).toHaveLength(2);
  await setDenoise(page, 'damaged/denoise.js');
  await expect.poll(warnings).toHaveLength(3);
  expect(await warnings()).toEqual([
    { code: 'element/denoise', message: expect.stringContaining('denoise="none.js"') },
    { code: 'element/denoise', message: expect.stringMatching(/denoise="other\.js".*denoising\(\)/) },
    { code: 'viewer/denoise', message: expect.stringContaining('shown with its noise') },
  ]);
  expect(await showsDenoised(page, 0.5)).toBe(false);
  expect(await heard(page, 'error')).toEqual([]);
  await expect(viewer(page).getByRole('alert')).toBeHidden();
  // The module that is named last counts; that of the others is not reported any more.
  await page.evaluate(() => {
    for (const address of ['none.js', 'grey.js']) document.querySelector('glanz-viewer')!.denoise = address;
  });
  await becomesDenoised(page);
  expect(await warnings()).toHaveLength(3);
  complaints = complaints.filter((text) => !text.includes('404'));
});

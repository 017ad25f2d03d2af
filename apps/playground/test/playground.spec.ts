import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { test } from '@glanz/browser/shared-device';
import { expect, type Page } from '@playwright/test';
import { hdr } from '@glanz/browser/files';
import { decodeExr } from '@glanz/image';
import {
  checkAccessibility,
  dataOf,
  drop,
  errorWith,
  fillRenderDialog,
  finished,
  open as openAt,
  photograph,
  imageOf as canvasOf,
  pixelsOf,
  plain,
  renderToFile,
  restarting,
  save,
  servePlayground,
  tab,
  themesAt,
  watch,
} from './page';

let origin = '';
let folder = '';
let close: () => Promise<void> = async () => undefined;

test.beforeAll(async ({ deviceHost }) => {
  ({ origin, folder, close } = await servePlayground());
  deviceHost.origin = origin;
});
test.afterAll(() => close());

// Small, as the software GPU is slow: the stage is 560 pixels wide and the film 70.
test.use({ viewport: { width: 900, height: 560 } });

let complaints: string[] = [];
test.beforeEach(({ page }) => void (complaints = watch(page, origin)));
test.afterEach(() => expect(complaints).toEqual([]));

const open = (page: Page, query = 'model=cornell-box&scale=0.125&samples=2&max-depth=3') =>
  openAt(page, `${origin}/?${query}`);

test('a model of another address is shown; one that is missing is reported, and the push-button is shown', async ({
  page,
}) => {
  const { createCornellBox } = await import('@glanz/models');
  const { sceneToGlb } = await import('@glanz/models/gltf');
  const body = Buffer.from(await sceneToGlb(createCornellBox()));
  await page.route('**/models/box.glb', (route) => route.fulfill({ body }));
  await open(page, 'model=models/box.glb&environment=none&scale=0.125&samples=2&max-depth=3');
  expect(await dataOf(page, 'scene')).toBe('box.glb');
  await finished(page);

  await page.route('**/models/gone.glb', (route) => route.fulfill({ status: 404 }));
  await open(page, 'model=models/gone.glb&scale=0.125&samples=1&max-depth=2');
  await expect(errorWith(page, 'playground/model-address')).toContainText('the server responded with status 404');
  expect(await dataOf(page, 'sample')).toBe('push-button');
  complaints = complaints.filter((text) => !text.includes('404'));
});

test('the Cornell box appears: light above, red left, green right; the saved image is the one on the screen', async ({
  page,
}) => {
  // One pixel of the film to one of the screen, so that they can be compared; not many of them.
  await page.setViewportSize({ width: 740, height: 340 });
  await open(page, 'model=cornell-box&scale=1&samples=1&max-depth=3');
  await expect.poll(async () => Number(await dataOf(page, 'samples'))).toBeGreaterThanOrEqual(1);
  await finished(page);
  const shown = await photograph(canvasOf(page));
  expect(shown.colours).toBeGreaterThan(2000);
  expect(shown.deviation).toBeGreaterThan(20);
  const [, top, , left, middle, right] = shown.cells as [number, number, number][];
  expect(left![0]).toBeGreaterThan(1.5 * left![1]);
  expect(right![1]).toBeGreaterThan(1.15 * right![0]);
  // The light is in the upper middle; the back wall is the brightest diffuse surface, lit in the light's warm colour.
  expect(top![0]).toBeGreaterThan(50);
  expect(middle![0]).toBeGreaterThan(middle![2]);
  expect(middle![0]).toBeGreaterThan(50);
  expect(middle![0]).toBeLessThan(235);

  const saved = await save(page, 'Save PNG');
  expect(saved.suggestedFilename()).toBe('cornell-box.png');
  const file = await pixelsOf(page, readFileSync(await saved.path()));
  const stage = (await canvasOf(page).boundingBox())!;
  expect([file.width, file.height]).toEqual([stage.width, stage.height]);
  // The tone map of the file runs on the CPU, that of the screen on the GPU.
  file.cells.forEach((cell, i) =>
    cell.forEach((mean, k) => expect(Math.abs(mean - shown.cells[i]![k]!), `cell ${i}, channel ${k}`).toBeLessThan(1)),
  );

  const exr = await save(page, 'Save EXR');
  const bytes = readFileSync(await exr.path());
  expect(bytes.readUInt32LE(0)).toBe(20000630);
  const header = bytes.subarray(0, 2000).toString('latin1');
  for (const channel of ['R', 'A', 'albedo.G', 'normal.X', 'depth.Z', 'object.id', 'material.id'])
    expect(header).toContain(`${channel}\0`);
});

test('an image of any size is rendered, to a file or the clipboard; the screen keeps its samples', async ({ page }) => {
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write'], { origin });
  await open(page, 'model=cornell-box&scale=0.125&samples=4&max-depth=3');
  await finished(page);
  const restarts = await dataOf(page, 'restarts');
  const dialog = page.getByRole('dialog', { name: 'Render image' });
  const show = async () => {
    await page.locator('#export').click();
    await page.getByRole('button', { name: 'Render image' }).click();
    await expect(dialog).toBeVisible();
  };
  await show();
  for (const scheme of themesAt(900)) {
    await page.emulateMedia({ colorScheme: scheme });
    expect(await checkAccessibility(page), scheme).toEqual([]);
    if (process.env['GLANZ_SCREENSHOTS'])
      await page.screenshot({ path: `${process.env['GLANZ_SCREENSHOTS']}/render-${scheme}.png` });
  }
  // The size does not depend on the film of the screen, which has an eighth of the stage's pixels.
  await expect(page.getByLabel('Width, pixels')).toHaveValue(String((await canvasOf(page).boundingBox())!.width));
  const png = await renderToFile(page, { width: 60, height: 90, samples: 3, format: 'PNG, 16 bits' });
  expect(png.suggestedFilename()).toBe('cornell-box.png');
  const bytes = readFileSync(await png.path());
  expect([bytes.readUInt32BE(16), bytes.readUInt32BE(20), bytes[24]]).toEqual([60, 90, 16]);
  expect(bytes.includes('3 samples per pixel')).toBe(true);
  // A taller image shows all of the box: red left, green right.
  const { cells } = await pixelsOf(page, bytes);
  expect(cells[3]![0]).toBeGreaterThan(1.3 * cells[3]![1]);
  expect(cells[5]![1]).toBeGreaterThan(1.1 * cells[5]![0]);

  await show();
  const exr = readFileSync(
    await (
      await renderToFile(page, {
        width: 33,
        height: 21,
        samples: 2,
        format: 'EXR, linear, with all layers and light groups',
      })
    ).path(),
  );
  const { width, height, channels } = decodeExr(exr);
  expect([width, height, channels.has('albedo.G'), channels.has('depth.Z')]).toEqual([33, 21, true, true]);

  // The clipboard, with an alpha channel.
  await show();
  await fillRenderDialog(page, { width: 40, height: 40, samples: 1, format: 'PNG, 8 bits', transparent: true });
  await page.getByRole('button', { name: 'Copy to clipboard' }).click();
  await expect(dialog.getByRole('status')).toHaveText('The image, 40 × 40, is on the clipboard.');
  const copied = await page.evaluate(async () => {
    const [item] = await navigator.clipboard.read();
    const bitmap = await createImageBitmap(await item!.getType('image/png'));
    return [bitmap.width, bitmap.height];
  });
  expect(copied).toEqual([40, 40]);

  // Cancelled, and closed while it renders.
  for (const end of ['Cancel', 'Close']) {
    await fillRenderDialog(page, { width: 64, height: 64, samples: 60_000 });
    await page.getByRole('button', { name: 'Save file' }).click();
    await expect(dialog).toContainText('of 60000 samples');
    await page.screenshot(
      process.env['GLANZ_SCREENSHOTS'] ? { path: `${process.env['GLANZ_SCREENSHOTS']}/render-running.png` } : {},
    );
    await dialog.getByRole('button', { name: end }).click();
    if (end === 'Cancel') await expect(dialog.getByRole('status')).toHaveText('Cancelled.');
    else await expect(dialog).toHaveCount(0);
  }
  // What the GPU cannot hold is an error in the dialog.
  await show();
  await fillRenderDialog(page, { width: 16_384, height: 16_384, samples: 1 });
  await page.getByRole('button', { name: 'Save file' }).click();
  await expect(dialog.getByRole('alert')).toContainText(/\w/);
  if (process.env['GLANZ_SCREENSHOTS'])
    await page.screenshot({ path: `${process.env['GLANZ_SCREENSHOTS']}/render-error.png` });
  await page.keyboard.press('Escape');
  await finished(page);
  expect([await dataOf(page, 'restarts'), await dataOf(page, 'samples')]).toEqual([restarts, '4']);
});

test('the first script is small, and controls come after the first model', async ({ page }) => {
  const dist = `${folder}/`;
  const html = readFileSync(`${dist}index.html`, 'utf8');
  // What the page asks for by itself, before any script runs.
  const first = [...html.matchAll(/(?:src|href)="\.\/(assets\/[^"]+\.js)"/g)].map(([, path]) => path!);
  const bytes = first.reduce((sum, path) => sum + gzipSync(readFileSync(dist + path)).length, 0);
  expect(first.length).toBeGreaterThan(0);
  expect(bytes).toBeLessThan(12_000);
  const asked: string[] = [];
  // What keeps copies of samples comes when the image is done, before the denoiser or after it.
  const copies: string[] = [];
  page.on('request', (request) => (/\/film-data-[^/]+\.js$/.test(request.url()) ? copies : asked).push(request.url()));
  await open(page, 'model=cornell-box&scale=0.125&samples=4&max-depth=3&denoise=on');
  const at = (name: RegExp) => asked.findIndex((url) => name.test(url));
  // The denoiser comes last.
  const denoiser = /\/denoise-[^/]+\.js$/;
  await expect.poll(() => at(/\.tza$/)).toBeGreaterThan(at(denoiser));
  expect(at(denoiser)).toBeGreaterThan(at(/\/panels-[^/]+\.js$/));
  expect(at(/\/panels-[^/]+\.js$/)).toBeGreaterThan(at(/\/load-worker-[^/]+\.js$/));
  // What the page's own thread has fetched: renderer, energy tables and the viewer's engine for the image (some 160
  // kB) with the names of the samples, which addresses and links hold, then panels.
  // Workers are not in it.
  const fetched = (urls: readonly string[]) => {
    const scripts = new Set(
      urls.map((url) => new URL(url).pathname).filter((path) => path.endsWith('.js') && !path.includes('worker')),
    );
    return [...scripts].reduce((sum, path) => sum + gzipSync(readFileSync(dist + path.slice(1))).length, 0);
  };
  expect(fetched(asked.slice(0, at(/\/panels-[^/]+\.js$/)))).toBeLessThan(191_000);
  expect(fetched(asked.slice(0, at(denoiser)))).toBeLessThan(211_600);
  // After that the denoiser, and one archive of weights; with those comes what computes the layers, WebAssembly here.
  const layers = /\/wasm-chain-[^/]+\.js$/;
  await expect.poll(() => at(layers)).toBeGreaterThan(at(denoiser));
  expect(fetched(asked.slice(at(denoiser), at(layers)))).toBeLessThan(21_000);
  expect(fetched(asked.slice(at(denoiser)))).toBeLessThan(23_100);
  expect(fetched(copies)).toBeLessThan(1_050);
  expect(asked.filter((url) => url.endsWith('.tza'))).toHaveLength(1);
  // Presets, encoders and decoders are loaded when they are needed.
  expect(
    asked.filter((url) =>
      /\/(presets|png|exr|materialx|draco|meshopt|render|render-dialog|render-image|save-image)(-[^/]*)?\.(js|wasm|css)$/.test(
        url,
      ),
    ),
  ).toEqual([]);
});

test('pause holds, and still shows a sample after a move', async ({ page }) => {
  await open(page, 'model=cornell-box&scale=0.125&samples=4096&max-depth=2');
  await expect.poll(async () => Number(await dataOf(page, 'samples'))).toBeGreaterThanOrEqual(1);
  await page.getByRole('button', { name: 'Pause' }).click();
  await expect(canvasOf(page)).toHaveAttribute('data-state', 'paused');
  const samples = Number(await dataOf(page, 'samples'));
  expect(samples).toBeLessThan(4096);
  await page.waitForTimeout(600);
  expect(Number(await dataOf(page, 'samples'))).toBe(samples);
  await canvasOf(page).press('ArrowRight');
  await expect.poll(async () => [await dataOf(page, 'state'), await dataOf(page, 'samples')]).toEqual(['paused', '1']);
  await canvasOf(page).press('Space');
  await expect.poll(async () => Number(await dataOf(page, 'samples'))).toBeGreaterThan(1);
});

const duck = fileURLToPath(new URL('../../../../shared/assets/Duck-Draco', import.meta.url));
const hasDuck = existsSync(duck);

test(`a folder with a compressed model and its texture${hasDuck ? '' : ' (skipped: the shared assets are not here)'}`, async ({
  page,
}) => {
  test.skip(!hasDuck);
  await open(page);
  await page.locator('#folder').setInputFiles(duck);
  await expect.poll(() => dataOf(page, 'scene')).toBe('Duck.gltf');
  await finished(page);
  await expect(page.locator('[data-statistic=triangles]')).toHaveText('4,212');
  // Its texture is yellow, before a grey environment: without it there would be no colour at all.
  const [r, g, b] = (await photograph(canvasOf(page))).cells[4]!;
  expect(r).toBeGreaterThan(g);
  expect(g).toBeGreaterThan(b + 25);
});

test('a dropped .hdr lights the scene and is seen behind it', async ({ page }) => {
  await open(page);
  await finished(page);
  await restarting(page, () => drop(page, [{ name: 'red room.hdr', bytes: hdr([128, 16, 16, 129]) }]));
  await tab(page, 'Light');
  await expect(page.locator('#environment option:checked')).toHaveText('red room.hdr');
  // Left of the box there is nothing but the environment: 1, 0.125, 0.125 through the tone map.
  const box = (await canvasOf(page).boundingBox())!;
  // The kernels for it may still be on their way, while those of before show their image.
  await expect(async () => {
    const { mean } = await pixelsOf(
      page,
      await page.screenshot({ clip: { x: box.x + 2, y: box.y + 100, width: 8, height: 200 } }),
    );
    expect(mean[0]).toBeGreaterThan(190);
    expect(mean[1]).toBeLessThan(mean[0] - 60);
  }).toPass({ timeout: 30_000 });

  // A link cannot hold the file: the page says so when it is made and when it is opened.
  await page.getByRole('button', { name: 'Share' }).click();
  await expect(page.locator('#share-note')).toContainText('red room.hdr');
  await page.locator('#copy-link').click();
  await expect(errorWith(page, 'playground/clipboard')).toContainText(`copy. The link: ${origin}/#`);
  await page.locator('#copy-code').click();
  await expect(errorWith(page, 'playground/clipboard').last()).toContainText('Select the code in the menu');
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  await page.locator('#copy-link').click();
  await expect(page.locator('#messages [role=status]', { hasText: 'on the clipboard' })).toContainText(
    'does not contain the environment "red room.hdr"',
  );
  const link = await page.evaluate(() => navigator.clipboard.readText());
  await page.goto('about:blank');
  await openAt(page, `${origin}/?model=cornell-box&scale=0.125&samples=2${new URL(link).hash}`);
  await expect(page.locator('[data-code="playground/link-file"]')).toContainText(
    'created with the environment "red room.hdr"',
  );
  await tab(page, 'Light');
  await expect(page.locator('#environment option:checked')).toHaveText('red room.hdr (not loaded)');
});

test('a lost device is replaced, and edits survive it', async ({ page }) => {
  await page.addInitScript(() => {
    window.ownDevices = true;
    const request = GPUAdapter.prototype.requestDevice;
    GPUAdapter.prototype.requestDevice = async function (descriptor) {
      const device = await request.call(this, descriptor);
      (globalThis as { lastDevice?: GPUDevice }).lastDevice = device;
      return device;
    };
    const { mapAsync } = GPUBuffer.prototype;
    const reads = ((globalThis as { reads?: Set<unknown> }).reads = new Set());
    GPUBuffer.prototype.mapAsync = function (...given) {
      const read = mapAsync.apply(this, given);
      reads.add(read);
      const end = () => void reads.delete(read);
      read.then(end, end);
      return read;
    };
  });
  await open(page);
  await finished(page);
  await page.locator('#material').selectOption({ label: 'red' });
  await restarting(page, () => page.locator('#parameter-base_color').fill('#2030ff'));
  const before = await photograph(canvasOf(page));
  // The samples are copied when the image is done.
  const reading = () =>
    page.evaluate(async () => {
      const { lastDevice, reads } = globalThis as { lastDevice?: GPUDevice; reads?: Set<unknown> };
      const { size } = reads!;
      await lastDevice!.queue.onSubmittedWorkDone();
      return size + reads!.size;
    });
  await expect.poll(reading).toBe(0);
  await page.evaluate(() => (globalThis as { lastDevice?: GPUDevice }).lastDevice?.destroy());
  // A note that goes by itself.
  await expect(page.locator('[data-code="playground/recovered"]')).toContainText(/keeps its \d+ samples/);
  await finished(page);
  await expect(page.locator('[role=alert]')).toHaveCount(0);
  const after = await photograph(canvasOf(page));
  after.cells[3]!.forEach((value, k) => expect(Math.abs(value - before.cells[3]![k]!)).toBeLessThan(1));
});

test('the push-button, and depth as one goes', async ({ page }) => {
  await open(page, 'model=push-button-low&scale=0.125&samples=4&max-depth=2');
  await finished(page);
  await expect(page.locator('[data-statistic=triangles]')).toHaveText(/^10,[5-9]\d\d$/);
  await tab(page, 'Render');
  // A slider whose lower end has more room: its place and the number agree.
  await page.locator('#samples').fill('0.5');
  await expect(page.getByRole('spinbutton', { name: 'Samples' })).toHaveValue('513');
  await page.getByRole('spinbutton', { name: 'Samples' }).fill('4');
  await page.getByRole('spinbutton', { name: 'Samples' }).press('Tab');
  await finished(page);
  const shallow = await photograph(canvasOf(page));
  expect(shallow.colours).toBeGreaterThan(3000);
  expect(shallow.deviation).toBeGreaterThan(20);
  const box = page.getByRole('spinbutton', { name: 'Depth', exact: true });
  await restarting(page, async () => {
    await box.fill('5');
    await box.press('Tab');
  });
  // Light that has met several surfaces can only add.
  expect((await photograph(canvasOf(page))).mean[1]).toBeGreaterThan(shallow.mean[1]);
});

test('every control has a name, and a phone shows the page without scrolling sideways', async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 780 });
  await open(page, 'model=cornell-box&scale=0.125&samples=1&max-depth=2');
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll<HTMLInputElement>('button, input, select, progress')]
      .filter((control) => !control.textContent?.trim() || control.tagName === 'SELECT')
      .filter(
        (control) =>
          !control.getAttribute('aria-label') &&
          !control.getAttribute('aria-labelledby') &&
          !(control.labels && control.labels.length > 0),
      )
      .map((control) => control.outerHTML),
  );
  expect(nameless).toEqual([]);
  const ids = await page.evaluate(() => [...document.querySelectorAll('[id]')].map((one) => one.id));
  expect(new Set(ids).size).toBe(ids.length);
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
  await finished(page);
});

test('without WebGPU the page says so and what to do', async ({ page }) => {
  await page.addInitScript(() => Object.defineProperty(navigator, 'gpu', { value: undefined, configurable: true }));
  await page.goto(origin);
  await expect(page.getByRole('heading', { name: 'This page needs WebGPU' })).toBeVisible();
  await expect(errorWith(page, 'renderer/no-webgpu')).toBeVisible();
  await expect(page.locator('#notice li').first()).toContainText('Chrome');
  await expect(page.getByRole('button', { name: 'Export' })).toBeDisabled();
});

test('without a GPU the page says so before its scripts are there; when one comes after all, the page works', async ({
  page,
}) => {
  let scripts = 0;
  let release: () => void = () => undefined;
  const released = new Promise<void>((resolve) => (release = resolve));
  await page.route('**/assets/app-*.js', async (route) => {
    scripts++;
    await released;
    await route.continue();
  });
  await page.addInitScript(() => {
    const { requestAdapter } = GPU.prototype;
    let asked = 0;
    GPU.prototype.requestAdapter = async function (...given) {
      return ++asked === 1 ? null : requestAdapter.apply(this, given);
    };
  });
  await page.goto(plain(`${origin}/?model=cornell-box&scale=0.125&samples=1&max-depth=2`));
  await expect(page.getByRole('heading', { name: 'The GPU cannot be used' })).toBeVisible();
  await expect(errorWith(page, 'renderer/no-adapter')).toBeVisible();
  await expect(page.locator('#preparing')).toBeHidden();
  await expect.poll(() => scripts).toBeGreaterThan(0);
  release();
  await finished(page);
  await expect(page.locator('#notice')).toBeHidden();
  await expect(page.locator('#model')).toBeEnabled();
});

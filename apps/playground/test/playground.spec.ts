import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { test } from '@glanz/browser/shared-device';
import { expect, type Page } from '@playwright/test';
import { hdr, triangle } from '@glanz/browser/files';
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
  expect(fetched(asked.slice(0, at(/\/panels-[^/]+\.js$/)))).toBeLessThan(190_600);
  expect(fetched(asked.slice(0, at(denoiser)))).toBeLessThan(211_300);
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

/**
 * One page for all: what takes the software GPU longest is to compile for each page again. Each test leaves the scene as
 * it was, up to the last ones; after a failure the next begins on a new page.
 */
test.describe('one page', () => {
  let page: Page;
  let said: string[] = [];

  test.beforeAll(async ({ browser }) => {
    page = await browser.newPage({ viewport: { width: 900, height: 560 } });
    said = watch(page, origin);
    await open(page);
    await finished(page);
  });
  test.afterEach(() => expect(said).toEqual([]));
  test.afterAll(() => page.close());

  test('exposure and tone map change the image without starting it again', async () => {
    await tab(page, 'Camera');
    const [restarts, before] = [await dataOf(page, 'restarts'), await photograph(canvasOf(page))];
    await page.getByLabel('Exposure, EV').fill('2');
    await page.getByLabel('Exposure, EV').press('Tab');
    await expect.poll(async () => (await photograph(canvasOf(page))).mean[0]).toBeGreaterThan(before.mean[0] * 1.3);
    const neutral = await photograph(canvasOf(page));
    await page.getByLabel('Tone map').selectOption('reinhard');
    await expect
      .poll(async () => Math.abs((await photograph(canvasOf(page))).mean[0] - neutral.mean[0]))
      .toBeGreaterThan(3);
    expect(await dataOf(page, 'restarts')).toBe(restarts);
    await page.getByLabel('Tone map', { exact: true }).selectOption('neutral');
    await page.getByLabel('Exposure, EV').fill('0');
    await page.getByLabel('Exposure, EV').press('Tab');
    // The next test begins with it.
    await expect
      .poll(async () => Math.abs((await photograph(canvasOf(page))).mean[0] - before.mean[0]))
      .toBeLessThan(0.5);
  });

  test('a click picks the material under it; its colour and a reset reach the image', async () => {
    await tab(page, 'Material');
    const before = await photograph(canvasOf(page));
    // The left wall, between the margin and the back wall.
    await canvasOf(page).click({ position: { x: 70, y: 250 } });
    await expect(page.locator('#material option:checked')).toHaveText('red');
    await expect(page.locator('#material-part')).toHaveText('Selected: Left wall');

    await restarting(page, () => page.locator('#parameter-base_color').fill('#2030ff'));
    const blue = await photograph(canvasOf(page));
    expect(before.cells[3]![0]).toBeGreaterThan(2 * before.cells[3]![2]);
    expect(blue.cells[3]![2]).toBeGreaterThan(1.2 * blue.cells[3]![0]);

    await restarting(page, () => page.getByRole('button', { name: 'Reset this material' }).click());
    // The colour may start the film twice, as it is entered and as it is done with.
    await expect
      .poll(async () => {
        await finished(page);
        return Math.abs((await photograph(canvasOf(page))).cells[3]![0] - before.cells[3]![0]);
      })
      .toBeLessThan(2);
  });

  test('drag, wheel and keys move the camera; reset brings the first view back', async () => {
    const canvas = canvasOf(page);
    const first = await photograph(canvas);
    const difference = async () => {
      const now = await photograph(canvas);
      return (
        now.cells.reduce(
          (sum, cell, i) => sum + cell.reduce((all, value, k) => all + Math.abs(value - first.cells[i]![k]!), 0),
          0,
        ) / 27
      );
    };
    await restarting(page, async () => {
      await page.mouse.move(200, 250);
      await page.mouse.down();
      await page.mouse.move(260, 260, { steps: 4 });
      await page.mouse.up();
    });
    expect(await difference()).toBeGreaterThan(4);
    await restarting(page, () => page.getByRole('button', { name: 'Reset view' }).click());
    await expect.poll(difference).toBeLessThan(0.5);

    await page.mouse.move(280, 300);
    for (const act of [
      () => canvas.press('ArrowLeft'),
      () => canvas.press('Shift+ArrowUp'),
      () => page.mouse.wheel(0, 300),
    ]) {
      await restarting(page, act);
      expect(await difference()).toBeGreaterThan(1.5);
      await restarting(page, () => canvas.press('Home'));
      await expect.poll(difference).toBeLessThan(0.5);
    }
  });

  test('layers: the walls have the normals that they must have, and materials have colours of their own', async () => {
    await tab(page, 'Render');
    const layer = async (name: string) => {
      await page.getByLabel('Layer', { exact: true }).selectOption(name);
      await expect(canvasOf(page)).toHaveAttribute('data-layer', name);
      await finished(page);
      return photograph(canvasOf(page));
    };
    const pixel = async () => {
      // A point of the left wall and one of the back wall, as in the picking test.
      const at = async (x: number, y: number) => {
        const box = (await canvasOf(page).boundingBox())!;
        return (
          await pixelsOf(page, await page.screenshot({ clip: { x: box.x + x, y: box.y + y, width: 4, height: 4 } }))
        ).mean;
      };
      return { left: await at(70, 250), back: await at(300, 170) };
    };
    await layer('normal');
    const normals = await pixel();
    // Codes of (1, 0, 0) and (0, 0, 1).
    [255, 128, 128].forEach((code, k) => expect(Math.abs(normals.left[k]! - code)).toBeLessThan(4));
    [128, 128, 255].forEach((code, k) => expect(Math.abs(normals.back[k]! - code)).toBeLessThan(4));
    await layer('materialId');
    const ids = await pixel();
    expect(Math.hypot(...ids.left.map((value, k) => value - ids.back[k]!))).toBeGreaterThan(40);
    await layer('depth');
    const depth = await pixel();
    expect(depth.left[0]).toBeGreaterThan(depth.back[0] + 20);
    await layer('beauty');
    expect((await pixel()).left[0]).toBeGreaterThan((await pixel()).left[2] * 1.5);
  });

  test('a change that needs other shaders: a matt wall becomes a mirror', async () => {
    await tab(page, 'Material');
    const piece = async (x: number, y: number, width: number, height: number) => {
      const box = (await canvasOf(page).boundingBox())!;
      const clip = { x: box.x + x, y: box.y + y, width, height };
      return (await pixelsOf(page, await page.screenshot({ clip }))).mean;
    };
    // Pieces of the right wall: near the back wall, and at its upper end.
    const wall = () => piece(430, 220, 20, 60);
    const top = () => piece(455, 65, 20, 10);
    const matt = await wall();
    expect(matt[1]).toBeGreaterThan(1.3 * matt[0]);
    expect((await top())[1]).toBeGreaterThan(20);
    await page.locator('#material').selectOption({ label: 'green' });
    await page.locator('#parameter-base_color').fill('#ffffff');
    for (const [name, value] of [
      ['specular_weight', '1'],
      ['specular_roughness', '0'],
      ['base_metalness', '1'],
    ]) {
      const box = page.locator(`.field:has(#parameter-${name}) input[type=number]`);
      await box.fill(value!);
      await box.press('Tab');
    }
    // It shows the back wall now, which is white in the warm light: less blue than green, less green than red. A matt
    // white wall is so, too, but its upper end has 0.46 of the light there, and that of the mirror, which shows the
    // room's open side, 0.24.
    await expect
      .poll(async () => {
        await finished(page);
        const [r, g, b] = await wall();
        return r > 1.1 * g && g > 1.1 * b && r > 60 && (await top())[0] < 0.35 * r;
      })
      .toBe(true);
  });

  test('dropped models: broken ones are reported in a line and the former scene stays, a good one takes its place', async () => {
    // The image that the test before has begun.
    await finished(page);
    const before = await photograph(canvasOf(page));
    const good = triangle([0.05, 0.1, 0.9]);
    const bad: [name: string, bytes: Buffer, code: string][] = [
      ['cut.glb', good.subarray(0, good.length - 20), 'gltf/truncated'],
      ['letter.glb', Buffer.from('Dear reader, this is no model.\n'), 'gltf/not-gltf'],
      ['notes.txt', Buffer.from('nothing'), 'playground/no-model'],
      ['empty.glb', triangle([1, 1, 1], (json) => (json['nodes'] = [{}])), 'gltf/no-triangles'],
      [
        'bare.glb',
        triangle([1, 1, 1], (json) =>
          Object.assign(json, {
            images: [{ uri: 'gone.png' }],
            textures: [{ source: 0 }],
            materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }],
          }),
        ),
        'gltf/missing-resource',
      ],
      ['dark.hdr', Buffer.from('#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n'), 'image/truncated'],
    ];
    for (const [name, bytes, code] of bad) {
      await drop(page, [{ name, bytes }]);
      await expect(errorWith(page, code), `${name} gives ${code}`).toBeVisible();
      expect((await errorWith(page, code).locator('p').innerText()).split('\n')).toHaveLength(1);
      expect(await dataOf(page, 'scene')).toBe('Cornell box');
      await errorWith(page, code).getByRole('button', { name: 'Close' }).click();
    }
    await finished(page);
    const after = await photograph(canvasOf(page));
    after.mean.forEach((mean, k) => expect(Math.abs(mean - before.mean[k]!)).toBeLessThan(1));

    await drop(page, [{ name: 'cut.glb', bytes: bad[0]![1] }]);
    await expect(errorWith(page, 'gltf/truncated')).toBeVisible();
    // An environment that is broken does not keep the model out that came with it.
    await drop(page, [
      { name: 'sail.glb', bytes: good },
      { name: 'dark.hdr', bytes: bad.at(-1)![1] },
    ]);
    await expect.poll(() => dataOf(page, 'scene')).toBe('sail.glb');
    await expect(page.locator('[role=status][data-code="playground/environment"]')).toContainText('HDR');
    await finished(page);
    await expect(page.locator('[role=alert]')).toHaveCount(0);
    await expect(page.locator('[data-statistic=triangles]')).toHaveText('1');
    await expect(page.locator('#material option:checked')).toHaveText('cloth');
    const sail = (await photograph(canvasOf(page))).cells[4]!;
    expect(sail[2]).toBeGreaterThan(1.5 * sail[0]);
  });

  test('hierarchies are built on workers, which stay for the next model', async () => {
    const pool = page.workers().filter((worker) => /\/assets\/worker-[^/]+$/.test(worker.url()));
    expect(pool.length).toBe(await page.evaluate(() => Math.min(8, navigator.hardwareConcurrency)));
    await drop(page, [{ name: 'other.glb', bytes: triangle([0.05, 0.1, 0.9]) }]);
    await expect.poll(() => dataOf(page, 'scene')).toBe('other.glb');
    expect(page.workers()).toEqual(expect.arrayContaining(pool));
  });
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

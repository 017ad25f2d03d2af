import { expect, test, type Page } from '@playwright/test';
import { triangle } from '@glanz/browser/files';
import {
  dataOf,
  drop,
  errorWith,
  finished,
  photograph,
  pixelsOf,
  restarting,
  tab,
  watch,
  open as openAt,
  imageOf as canvasOf,
  servePlayground,
} from './page';

let origin = '';
let close: () => Promise<void> = async () => undefined;

test.beforeAll(async () => void ({ origin, close } = await servePlayground()));
test.afterAll(() => close());

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
    await openAt(page, `${origin}/?model=cornell-box&scale=0.125&samples=2&max-depth=3`);
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

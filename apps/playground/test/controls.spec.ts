import { test } from '@glanz/browser/shared-device';
import { expect, type Page } from '@playwright/test';
import { triangle } from '@glanz/browser/files';
import {
  dataOf,
  drop,
  finished,
  open as openAt,
  photograph,
  imageOf,
  pixelsOf,
  restarting,
  servePlayground,
  tab,
  watch,
} from './page';

let origin = '';
let close: () => Promise<void> = async () => undefined;

test.beforeAll(async ({ deviceHost }) => {
  ({ origin, close } = await servePlayground());
  deviceHost.origin = origin;
});
test.afterAll(() => close());
test.use({ viewport: { width: 900, height: 560 } });

let complaints: string[] = [];
test.beforeEach(({ page }) => void (complaints = watch(page, origin)));
test.afterEach(() => expect(complaints).toEqual([]));

const open = (page: Page, query = 'model=cornell-box&scale=0.125&samples=2&max-depth=2') =>
  openAt(page, `${origin}/?${query}`);

/** Mean of a small piece of the image. */
async function piece(page: Page, x: number, y: number): Promise<readonly [number, number, number]> {
  const box = (await imageOf(page).boundingBox())!;
  return (await pixelsOf(page, await page.screenshot({ clip: { x: box.x + x, y: box.y + y, width: 24, height: 24 } })))
    .mean;
}

/** A sail that moves two metres to the right within a second. */
function moving(): Buffer {
  const positions = Float32Array.of(-1, -1, 0, 1, -1, 0, 0, 1, 0);
  const times = Float32Array.of(0, 1);
  const places = Float32Array.of(0, 0, 0, 2, 0, 0);
  return triangle([0.9, 0.05, 0.05], (json) => {
    Object.assign(json, {
      nodes: [
        { name: 'Sail', mesh: 0 },
        { name: 'Wall', mesh: 1, translation: [0, 0, -4], scale: [6, 6, 1] },
      ],
      scenes: [{ nodes: [0, 1] }],
      meshes: [
        { primitives: [{ attributes: { POSITION: 0 }, material: 0 }] },
        { primitives: [{ attributes: { POSITION: 0 }, material: 1 }] },
      ],
      materials: [
        {
          name: 'cloth',
          pbrMetallicRoughness: { baseColorFactor: [0.9, 0.05, 0.05, 1], metallicFactor: 0, roughnessFactor: 1 },
        },
        { name: 'wall', pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 1 } },
      ],
      buffers: [
        {
          byteLength: 36 + 8 + 24,
          uri: `data:application/octet-stream;base64,${Buffer.concat([positions, times, places].map((part) => Buffer.from(part.buffer))).toString('base64')}`,
        },
      ],
      bufferViews: [
        { buffer: 0, byteLength: 36 },
        { buffer: 0, byteOffset: 36, byteLength: 8 },
        { buffer: 0, byteOffset: 44, byteLength: 24 },
      ],
      accessors: [
        { bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [-1, -1, 0], max: [1, 1, 0] },
        { bufferView: 1, componentType: 5126, count: 2, type: 'SCALAR', min: [0], max: [1] },
        { bufferView: 2, componentType: 5126, count: 2, type: 'VEC3' },
      ],
      animations: [
        {
          name: 'Tack',
          samplers: [{ input: 1, output: 2 }],
          channels: [{ sampler: 0, target: { node: 0, path: 'translation' } }],
        },
      ],
    });
  });
}

test('an animation poses the model: its time moves a part, edits stay, and rest is rest again', async ({ page }) => {
  await open(page);
  await drop(page, [{ name: 'moving.glb', bytes: moving() }]);
  await expect.poll(() => dataOf(page, 'scene')).toBe('moving.glb');
  await finished(page);
  const red = async () => {
    const { cells } = await photograph(imageOf(page));
    // Where the red is: its centre among the columns.
    const redness = cells.map(([r, g]) => Math.max(0, r - g));
    const total = redness.reduce((sum, value) => sum + value, 0);
    return redness.reduce((sum, value, i) => sum + value * (i % 3), 0) / total;
  };
  const rest = await red();
  await tab(page, 'Render');
  await page.getByLabel('Animation', { exact: true }).selectOption('Tack');
  const time = page.getByRole('spinbutton', { name: 'Time, s' });
  await time.fill('1');
  await restarting(page, () => time.press('Tab'));
  await expect(async () => {
    await finished(page);
    expect(await red()).toBeGreaterThan(rest + 0.2);
  }).toPass();
  const restarts = Number(await dataOf(page, 'restarts'));

  // Played, the sail moves by itself, and the time with it; the image of the moment at which it is stopped is
  // finished.
  await time.fill('0');
  await time.press('Tab');
  await page.getByRole('button', { name: 'Play the animation' }).click();
  const seen = new Set<string>();
  await expect
    .poll(async () => seen.add(await time.inputValue()).size, { message: 'the time advances' })
    .toBeGreaterThan(3);
  expect(Number(await dataOf(page, 'restarts'))).toBeGreaterThan(restarts + 3);
  // It repeats: a stop just after it began again would show the sail at rest, which proves nothing, so it is played
  // until it stops later.
  let moment = 0;
  await expect(async () => {
    await page.getByRole('button', { name: 'Stop the animation' }).click();
    await expect(page.getByRole('button', { name: 'Play the animation' })).toHaveAttribute('aria-pressed', 'false');
    moment = Number(await time.inputValue());
    if (!(moment > 0.25)) await page.getByRole('button', { name: 'Play the animation' }).click();
    expect(moment).toBeGreaterThan(0.25);
  }).toPass();
  // Half-way it would be a metre to the right of where it rests.
  await expect(async () => {
    await finished(page);
    expect((await red()) - rest).toBeGreaterThan(0.1 * Math.min(1, moment));
  }).toPass();

  await page.getByLabel('Animation', { exact: true }).selectOption('Rest pose');
  await expect(async () => {
    await finished(page);
    expect(Math.abs((await red()) - rest)).toBeLessThan(0.1);
  }).toPass();
});

test('while the user turns the model a small preview keeps up on the same canvas; the image in full takes over, and ends the same', async ({
  page,
}) => {
  // So many pixels that a frame of all of them takes longer than a preview may.
  await open(page, 'model=cornell-box&scale=0.25&samples=4&max-depth=3');
  await finished(page);
  const before = await photograph(imageOf(page));
  const [width, canvas] = await imageOf(page).evaluate(
    (image: HTMLCanvasElement) => [image.dataset['film'], `${image.width} ${image.height}`] as const,
  );
  // Every film that is drawn and every state, as they come.
  await page.evaluate(() => {
    const image = document.querySelector<HTMLCanvasElement>('#image')!;
    const seen = ((globalThis as { seen?: string[] }).seen = [] as string[]);
    new MutationObserver(() => {
      const now = `${image.dataset['state']} ${image.dataset['film']} of ${image.width} ${image.height}`;
      if (seen.at(-1) !== now) seen.push(now);
    }).observe(image, { attributes: true });
  });
  await restarting(page, async () => {
    await page.mouse.move(200, 250);
    await page.mouse.down();
    await page.mouse.move(240, 250, { steps: 6 });
    await page.mouse.move(200, 250, { steps: 6 });
    await page.mouse.up();
  });
  const seen = await page.evaluate(() => (globalThis as { seen?: string[] }).seen!);
  const previews = seen.filter((line) => line.startsWith('moving')).map((line) => Number(line.split(' ')[1]));
  expect(previews.length).toBeGreaterThan(0);
  expect(Math.min(...previews)).toBeLessThan(0.8 * Number(width!.split(' ')[0]));
  expect(seen.every((line) => line.endsWith(`of ${canvas}`))).toBe(true);
  expect(seen.at(-1)).toBe(`done ${width} of ${canvas}`);
  // Back where it began, nothing of the preview is left in the image.
  const after = await photograph(imageOf(page));
  after.cells.forEach((cell, i) =>
    cell.forEach((value, k) => expect(Math.abs(value - before.cells[i]![k]!), `cell ${i}`).toBeLessThan(1)),
  );
});

test('keys: undo, views, projection, hiding; the list of keys; none of them while typing', async ({ page }) => {
  await open(page);
  await finished(page);
  const first = await photograph(imageOf(page));
  const difference = async () =>
    (await photograph(imageOf(page))).cells.reduce((sum, cell, i) => sum + Math.abs(cell[0] - first.cells[i]![0]), 0) /
    9;
  // The left wall, then away with it.
  await imageOf(page).click({ position: { x: 70, y: 250 } });
  await expect(page.locator('#outline')).toHaveAttribute('data-part', /\d+/);
  const wall = await piece(page, 60, 230);
  await restarting(page, () => page.keyboard.press('h'));
  expect((await piece(page, 60, 230))[0]).toBeLessThan(0.7 * wall[0]);
  await restarting(page, () => page.keyboard.press('Shift+H'));
  await expect(page.locator('#parts li.off')).toHaveCount(0);
  await restarting(page, () => page.keyboard.press('Control+z'));
  await expect(page.locator('#parts li.off')).toHaveCount(1);
  await restarting(page, () => page.keyboard.press('Control+z'));
  await expect.poll(async () => Math.abs((await piece(page, 60, 230))[0] - wall[0])).toBeLessThan(8);

  await restarting(page, () => page.keyboard.press('9'));
  expect(await difference()).toBeGreaterThan(5);
  await restarting(page, () => page.keyboard.press('5'));
  await tab(page, 'Camera');
  await expect(page.locator('#projection')).toHaveValue('orthographic');
  await restarting(page, () => page.keyboard.press('5'));

  // Focus: a click measures the distance and opens the aperture.
  await page.keyboard.press('d');
  await expect(page.locator('#focus')).toHaveAttribute('aria-pressed', 'true');
  await restarting(page, () => imageOf(page).click({ position: { x: 280, y: 250 } }));
  await expect(page.locator('#stop')).toHaveValue('2.8');
  await page.keyboard.press('d');

  const restarts = await dataOf(page, 'restarts');
  await tab(page, 'Scene');
  await page.getByLabel('Search parts').pressSequentially('h9');
  expect(await dataOf(page, 'restarts')).toBe(restarts);
  await page.getByLabel('Search parts').fill('');
  await page.getByRole('button', { name: 'Keys and mouse' }).click();
  await expect(page.getByRole('dialog')).toBeVisible();
  await page.keyboard.press('Escape');
  await expect(page.getByRole('dialog')).toBeHidden();
});

test('a preset that is dragged to the image is put on the part under it', async ({ page }) => {
  await open(page);
  await finished(page);
  await page.getByText('Presets').click();
  await page.getByLabel('Search presets').fill('blackboard');
  const before = await piece(page, 60, 230);
  await restarting(page, () =>
    page.locator('[data-preset=blackboard]').dragTo(imageOf(page), { targetPosition: { x: 70, y: 250 } }),
  );
  await expect(page.locator('#material option:checked')).toHaveText('red');
  expect((await piece(page, 60, 230))[0]).toBeLessThan(0.6 * before[0]);
  await expect(page.locator('[data-group=base] .dot')).toBeVisible();
  await restarting(page, () => page.getByRole('button', { name: 'Reset this material' }).click());
  await expect.poll(async () => Math.abs((await piece(page, 60, 230))[0] - before[0])).toBeLessThan(8);
});

import { readFileSync } from 'node:fs';
import { deflateRawSync, inflateRawSync } from 'node:zlib';
import { expect, test, type Page } from '@playwright/test';
import { triangle } from '@glanz/browser/files';
import { usdSquare, usdz } from '@glanz/browser/usd';
import {
  checkAccessibility,
  dataOf,
  drop,
  errorWith,
  finished,
  open as openAt,
  photograph,
  imageOf,
  pixelsOf,
  restarting,
  save,
  servePlayground,
  tab,
  watch,
} from './page';

let origin = '';
let close: () => Promise<void> = async () => undefined;

test.beforeAll(async () => ({ origin, close } = await servePlayground()));
test.afterAll(() => close());
test.use({ viewport: { width: 900, height: 560 } });

let complaints: string[] = [];
test.beforeEach(({ page }) => void (complaints = watch(page, origin)));
test.afterEach(() => expect(complaints).toEqual([]));

const open = (page: Page, query = 'model=cornell-box&scale=0.125&samples=2&max-depth=3', hash = '') =>
  openAt(page, `${origin}/?${query}${hash}`);

/** Two sails, the left one with a red look; a third node is a little one behind. */
const sails = () =>
  triangle([0.05, 0.1, 0.9], (json) => {
    Object.assign(json, {
      scenes: [{ nodes: [0, 1] }],
      nodes: [
        { name: 'Left', mesh: 0, translation: [-1.1, 0, 0] },
        { name: 'Right', mesh: 1, translation: [1.1, 0, 0] },
      ],
      meshes: [
        {
          primitives: [
            {
              attributes: { POSITION: 0 },
              material: 0,
              extensions: { KHR_materials_variants: { mappings: [{ material: 1, variants: [0] }] } },
            },
          ],
        },
        { primitives: [{ attributes: { POSITION: 0 }, material: 2 }] },
      ],
      extensionsUsed: ['KHR_materials_variants'],
      extensions: { KHR_materials_variants: { variants: [{ name: 'storm' }] } },
    });
    const matt = (name: string, colour: readonly number[]) => ({
      name,
      pbrMetallicRoughness: { baseColorFactor: [...colour, 1], metallicFactor: 0, roughnessFactor: 1 },
    });
    json['materials'] = [
      matt('cloth', [0.05, 0.1, 0.9]),
      matt('storm cloth', [0.9, 0.05, 0.05]),
      matt('canvas', [0.05, 0.6, 0.1]),
    ];
  });

/** Mean colours of the left and the right third of the image's middle row. */
async function halves(page: Page) {
  const { cells } = await photograph(imageOf(page));
  return { left: cells[3]!, right: cells[5]! };
}

const MTLX = `<?xml version="1.0"?>
<materialx version="1.39" colorspace="lin_rec709">
  <open_pbr_surface name="paint_surface" type="surfaceshader">
    <input name="base_color" type="color3" value="0.8, 0.02, 0.7" />
    <input name="specular_roughness" type="float" value="0.9" />
  </open_pbr_surface>
  <surfacematerial name="paint" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="paint_surface" />
  </surfacematerial>
</materialx>`;

test('a dropped .usdz, and a .usda with its image beside it', async ({ page }) => {
  await open(page);
  await drop(page, [{ name: 'blue.usdz', bytes: usdz(usdSquare([0.02, 0.05, 0.8])) }]);
  await expect.poll(() => dataOf(page, 'scene')).toBe('blue.usdz');
  await finished(page);
  const { left } = await halves(page);
  expect(left[2]).toBeGreaterThan(1.4 * left[0]);
  const layer = usdSquare([0.5, 0.5, 0.5]).replace(
    'color3f inputs:diffuseColor = (0.5, 0.5, 0.5)',
    'color3f inputs:diffuseColor.connect = </Square/Paint/Image.outputs:rgb>',
  );
  const image = `def Shader "Image" {
            uniform token info:id = "UsdUVTexture"
            asset inputs:file = @./orange.png@
        }

        def Shader "Surface"`;
  await drop(page, [
    { name: 'orange.usda', bytes: Buffer.from(layer.replace('def Shader "Surface"', image)) },
    { name: 'orange.png', bytes: await png(page, '#ff8000') },
  ]);
  await expect.poll(() => dataOf(page, 'scene')).toBe('orange.usda');
  await finished(page);
  const second = await halves(page);
  expect(second.left[0]).toBeGreaterThan(1.4 * second.left[2]);
});

test('a model from file to file: converge, material, variant, .mtlx, a bad file, size, hide and show, undo, export', async ({
  page,
}) => {
  await open(page);
  await drop(page, [{ name: 'sails.glb', bytes: sails() }]);
  await expect.poll(() => dataOf(page, 'scene')).toBe('sails.glb');
  await finished(page);
  const first = await halves(page);
  expect(first.left[2]).toBeGreaterThan(1.4 * first.left[0]);
  expect(first.right[1]).toBeGreaterThan(1.2 * first.right[2]);

  // A preset, by its image.
  await page.locator('#material').selectOption({ label: 'canvas' });
  await page.getByText('Presets').click();
  await page.getByLabel('Search presets').fill('blackboard');
  await restarting(page, () => page.locator('[data-preset=blackboard]').click());
  const dark = await halves(page);
  expect(dark.right[1]).toBeLessThan(0.6 * first.right[1]);

  // A variant, and back by the history.
  await tab(page, 'Render');
  await page.evaluate(() => {
    const list = document.querySelector<HTMLSelectElement>('#material')!;
    list.value = '0';
    list.dispatchEvent(new Event('change'));
  });
  await restarting(page, () => page.getByLabel('Variant', { exact: true }).selectOption('storm'));
  // The material to edit is the one that is seen.
  await expect(page.locator('#material option:checked')).toHaveText('storm cloth');
  const storm = await halves(page);
  expect(storm.left[0]).toBeGreaterThan(1.4 * storm.left[2]);
  await restarting(page, () => page.getByRole('button', { name: 'Undo: Variant' }).click());
  expect((await halves(page)).left[2]).toBeGreaterThan(1.4 * storm.left[2]);
  await restarting(page, () => page.keyboard.press('Control+Shift+Z'));
  expect((await halves(page)).left[0]).toBeGreaterThan(1.4 * storm.left[2]);
  await restarting(page, () => page.getByLabel('Variant', { exact: true }).selectOption('Default'));
  await expect(page.locator('#material option:checked')).toHaveText('cloth');
  await page.evaluate(() => {
    const list = document.querySelector<HTMLSelectElement>('#material')!;
    list.value = '2';
    list.dispatchEvent(new Event('change'));
  });

  // A MaterialX document goes to the chosen material.
  await tab(page, 'Material');
  await restarting(page, () => drop(page, [{ name: 'paint.mtlx', bytes: Buffer.from(MTLX) }]));
  const pink = await halves(page);
  expect(pink.right[0]).toBeGreaterThan(1.5 * pink.right[1]);
  expect(pink.right[2]).toBeGreaterThan(1.5 * pink.right[1]);
  await drop(page, [{ name: 'broken.mtlx', bytes: Buffer.from('<materialx') }]);
  await expect(page.locator('[role=alert]')).toBeVisible();
  await page.locator('[role=alert]').getByRole('button', { name: 'Close' }).click();

  // A bad model changes nothing.
  await drop(page, [{ name: 'cut.glb', bytes: sails().subarray(0, 300) }]);
  await expect(errorWith(page, 'gltf/truncated')).toBeVisible();
  expect(await dataOf(page, 'scene')).toBe('sails.glb');

  // Another size.
  await restarting(page, () => page.setViewportSize({ width: 760, height: 620 }));
  const narrow = await halves(page);
  expect(narrow.left[2]).toBeGreaterThan(1.3 * narrow.left[0]);
  expect(narrow.right[0]).toBeGreaterThan(1.4 * narrow.right[1]);

  // Hide and show.
  await tab(page, 'Scene');
  await restarting(page, () => page.getByRole('button', { name: 'Show Left' }).click());
  const bare = await halves(page);
  expect(Math.abs(bare.left[2] - bare.left[0])).toBeLessThan(12);
  await restarting(page, () => page.getByRole('button', { name: 'Show all (1 hidden)' }).click());
  expect((await halves(page)).left[2]).toBeGreaterThan(1.3 * narrow.left[0]);

  // What comes out.
  const png = readFileSync(await (await save(page, 'Save 16-bit PNG')).path());
  expect(png.readUInt8(24)).toBe(16);
  const glb = readFileSync(await (await save(page, 'Save glTF')).path());
  const json = JSON.parse(glb.subarray(20, 20 + glb.readUInt32LE(12)).toString()) as {
    materials: { name: string; pbrMetallicRoughness: { baseColorFactor: number[]; roughnessFactor: number } }[];
    extensions: unknown;
  };
  const canvas = json.materials.find(({ name }) => name === 'canvas')!.pbrMetallicRoughness;
  [0.8, 0.02, 0.7].forEach((value, k) => expect(canvas.baseColorFactor[k]).toBeCloseTo(value, 4));
  expect(canvas.roughnessFactor).toBeCloseTo(0.9, 4);
  expect(json.extensions).toEqual({ KHR_materials_variants: { variants: [{ name: 'storm' }] } });
  const mtlx = readFileSync(await (await save(page, 'Save MaterialX')).path(), 'utf8');
  expect(mtlx).toContain('open_pbr_surface');
  // The file that came out goes in again and looks the same.
  await drop(page, [{ name: 'again.glb', bytes: glb }]);
  await expect.poll(() => dataOf(page, 'scene')).toBe('again.glb');
  await finished(page);
  const again = await halves(page);
  again.right.forEach((value, k) => expect(Math.abs(value - narrow.right[k]!)).toBeLessThan(6));
});

test('the address holds the view: a reload brings back camera, material, light and hidden parts', async ({ page }) => {
  await open(page);
  await finished(page);
  await page.locator('#material').selectOption({ label: 'red' });
  await restarting(page, () => page.locator('#parameter-base_color').fill('#2030ff'));
  await tab(page, 'Camera');
  await restarting(page, () => page.getByRole('button', { name: 'Corner' }).click());
  await page.getByLabel('Exposure, EV').fill('0.8');
  await page.getByLabel('Exposure, EV').press('Tab');
  await page.keyboard.press('Escape');
  await restarting(page, async () => {
    await tab(page, 'Scene');
    await page.getByRole('button', { name: 'Show Tall block' }).click();
  });
  // The address follows a while after the last change.
  const hidden = () => {
    const { hash } = new URL(page.url());
    const { s = {} } =
      hash === ''
        ? {}
        : (JSON.parse(inflateRawSync(Buffer.from(hash.replace('#v1.', ''), 'base64url')).toString()) as {
            s?: { hidden?: readonly number[] };
          });
    return s.hidden?.length ?? 0;
  };
  await expect.poll(hidden).toBe(1);
  const before = await photograph(imageOf(page));
  await page.reload();
  await expect(page.locator('body')).toHaveAttribute('data-panels', 'ready');
  await finished(page);
  const after = await photograph(imageOf(page));
  after.cells.forEach((cell, i) =>
    cell.forEach((value, k) => expect(Math.abs(value - before.cells[i]![k]!), `cell ${i}`).toBeLessThan(2)),
  );
  await tab(page, 'Scene');
  await expect(page.getByRole('button', { name: 'Show all (1 hidden)' })).toBeVisible();

  // A damaged link is ignored.
  await page.goto('about:blank');
  await open(page, 'model=cornell-box&scale=0.125&samples=2&max-depth=2', '#v1.spoiled');
  await finished(page);
  await expect(page.locator('[role=alert]')).toHaveCount(0);

  // Nor is one with values that the page itself would never write.
  const absurd = {
    samples: 2,
    maxDepth: 1.5,
    scale: '0.25',
    exposure: 1e30,
    hidden: [1e9, -1],
    camera: 1e9,
    clip: 3,
    variant: 'none such',
    orbit: { target: [0, 1, 0], distance: 1e30, yaw: 1e30, pitch: 7 },
    lens: { fov: 0, stop: -2 },
    boxes: [{}],
    groups: { x: 1 },
    materials: { 0: { base_color: 'red' }, 1: { base_metalness: 1e30 }, 99: {} },
  };
  await page.goto('about:blank');
  await open(
    page,
    'model=cornell-box&scale=0.125&samples=2&max-depth=2',
    `#v1.${deflateRawSync(JSON.stringify({ m: 'cornell-box', s: absurd })).toString('base64url')}`,
  );
  await finished(page);
  await expect(page.locator('[role=alert]')).toHaveCount(0);
  await tab(page, 'Render');
  await expect(page.locator('#maxDepth')).toHaveValue('2');
});

test('light: studios, a soft box, backgrounds that are saved as they are seen, and lights dimmed without a sample', async ({
  page,
}) => {
  // One pixel of the film to one of the screen, so that the saved image can be compared; not many of them.
  await page.setViewportSize({ width: 740, height: 340 });
  await open(page, 'model=cornell-box&scale=1&samples=1&max-depth=2&environment=studio');
  await finished(page);
  await tab(page, 'Light');
  // Beside the box there is the environment.
  const beside = async () => {
    const box = (await imageOf(page).boundingBox())!;
    return (
      await pixelsOf(page, await page.screenshot({ clip: { x: box.x + 4, y: box.y + 80, width: 12, height: 120 } }))
    ).mean;
  };
  await restarting(page, () => page.locator('[data-studio=sunset]').click());
  await expect
    .poll(async () => {
      const [r, , b] = await beside();
      return r - b;
    })
    .toBeGreaterThan(25);
  await restarting(page, () => page.locator('[data-studio=low-key]').click());
  await expect.poll(async () => (await beside())[0]).toBeLessThan(90);
  await restarting(page, () => page.getByRole('button', { name: 'Add soft box' }).click());
  await expect(page.locator('.sky button')).toHaveCount(5);
  await restarting(page, () => page.getByLabel('Soft box 5').press('ArrowUp'));

  await restarting(page, () => page.getByLabel('Background', { exact: true }).selectOption('color'));
  await page.locator('#background-color').fill('#20c040');
  await expect.poll(async () => (await beside()).map(Math.round)).toEqual([0x20, 0xc0, 0x40]);
  const saved = await pixelsOf(page, readFileSync(await (await save(page, 'Save PNG')).path()));
  const shown = await photograph(imageOf(page));
  saved.cells.forEach((cell, i) =>
    cell.forEach((value, k) =>
      expect(Math.abs(value - shown.cells[i]![k]!), `cell ${i}, channel ${k}`).toBeLessThan(1),
    ),
  );

  await tab(page, 'Light');
  await restarting(page, () => page.getByLabel('Relight', { exact: true }).check());
  await expect(page.locator('#light-groups .light')).toHaveCount(2);
  await finished(page);
  const restarts = await dataOf(page, 'restarts');
  const lit = await photograph(imageOf(page));
  const strength = page.locator('#light-groups .field', { hasText: 'light' }).locator('input[type=number]').last();
  await strength.fill('0');
  await strength.press('Tab');
  await expect.poll(async () => (await photograph(imageOf(page))).cells[4]![0]).toBeLessThan(0.8 * lit.cells[4]![0]);
  expect(await dataOf(page, 'restarts')).toBe(restarts);
});

/** A PNG of one colour, made by the page's own browser. */
const png = async (page: Page, colour: string) =>
  Buffer.from(
    await page.evaluate(async (fill) => {
      const canvas = new OffscreenCanvas(4, 4);
      const context = canvas.getContext('2d')!;
      context.fillStyle = fill;
      context.fillRect(0, 0, 4, 4);
      return [...new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer())];
    }, colour),
  );

test('an image on a parameter multiplies it, and goes again; a file that is no image is reported', async ({ page }) => {
  await open(page);
  await drop(page, [{ name: 'sails.glb', bytes: sails() }]);
  await expect.poll(() => dataOf(page, 'scene')).toBe('sails.glb');
  await finished(page);
  await page.locator('#material').selectOption({ label: 'cloth' });
  await restarting(page, () => page.locator('#parameter-base_color').fill('#ffffff'));
  const white = await halves(page);
  const row = page.locator('.field:has(#parameter-base_color)');
  await row
    .locator('input[type=file]')
    .setInputFiles({ name: 'orange.png', mimeType: 'image/png', buffer: await png(page, '#ff8000') });
  await expect(row.locator('.slot-name')).toHaveText('× orange.png');
  // There are no coordinates to look it up by: the page says so, and the image is one colour everywhere anyway.
  await expect(page.getByText('has UV coordinates', { exact: false })).toBeVisible();
  await expect(async () => {
    await finished(page);
    const { left } = await halves(page);
    expect(left[0]).toBeGreaterThan(1.5 * left[2]);
    expect(left[1]).toBeGreaterThan(1.1 * left[2]);
  }).toPass();
  await row.getByRole('button', { name: 'Remove the texture of Base Color' }).click();
  await expect(async () => {
    await finished(page);
    const { left } = await halves(page);
    left.forEach((value, k) => expect(Math.abs(value - white.left[k]!)).toBeLessThan(3));
  }).toPass();
  await row
    .locator('input[type=file]')
    .setInputFiles({ name: 'words.png', mimeType: 'image/png', buffer: Buffer.from('no image') });
  await expect(errorWith(page, 'playground/image')).toBeVisible();
});

/** Share of pixels of the saved image that are neither empty nor full. */
const veiled = async (page: Page) =>
  page.evaluate(
    async (base64) => {
      const bitmap = await createImageBitmap(
        new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: 'image/png' }),
        { premultiplyAlpha: 'none' },
      );
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d')!;
      context.drawImage(bitmap, 0, 0);
      const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
      let count = 0;
      for (let i = 3; i < data.length; i += 4) if (data[i]! > 12 && data[i]! < 243) count++;
      return count / (data.length / 4);
    },
    readFileSync(await (await save(page, 'Save PNG')).path()).toString('base64'),
  );

test('the floor catches the shadow only; the blurred background is smooth, and saved as it is seen', async ({
  page,
}) => {
  // As in the test of light.
  await page.setViewportSize({ width: 740, height: 340 });
  await open(page, 'model=push-button-low&scale=1&samples=1&max-depth=2');
  await finished(page);
  await tab(page, 'Light');
  await restarting(page, () => page.getByLabel('Background', { exact: true }).selectOption('blurred'));
  await expect(page.locator('#backdrop')).toBeVisible();
  const corner = async (bytes: Buffer) => pixelsOf(page, bytes);
  const box = (await imageOf(page).boundingBox())!;
  const seen = await corner(
    await page.screenshot({ clip: { x: box.x + 8, y: box.y + 0.6 * box.height, width: 40, height: 0.2 * box.height } }),
  );
  expect(seen.deviation).toBeLessThan(6);
  expect(seen.mean[0]).toBeGreaterThan(60);
  const shown = await photograph(imageOf(page));
  const saved = await pixelsOf(page, readFileSync(await (await save(page, 'Save PNG')).path()));
  // The browser enlarges the backdrop in its own way.
  saved.cells.forEach((cell, i) =>
    cell.forEach((value, k) =>
      expect(Math.abs(value - shown.cells[i]![k]!), `cell ${i}, channel ${k}`).toBeLessThan(2),
    ),
  );

  // The film is as it was: only what the page puts behind it goes.
  await page.getByLabel('Background', { exact: true }).selectOption('transparent');
  await expect(page.locator('#backdrop')).toBeHidden();
  const clear = await veiled(page);
  await restarting(page, () => page.getByLabel('Floor shadow', { exact: true }).check());
  // A shadow is a veil; without it only edges are half there.
  expect(clear).toBeLessThan(0.05);
  expect(await veiled(page)).toBeGreaterThan(clear + 0.1);
  await tab(page, 'Light');
  await page.getByLabel('Floor shadow', { exact: true }).uncheck();
  await finished(page);
});

test('no accessibility faults in any panel, menu or message, light and dark, at three sizes; nothing wider than the window', async ({
  page,
}) => {
  test.setTimeout(600_000);
  await open(page, 'model=cornell-box&scale=0.125&samples=1&max-depth=2');
  await drop(page, [{ name: 'sails.glb', bytes: sails() }]);
  await expect.poll(() => dataOf(page, 'scene')).toBe('sails.glb');
  await page.getByText('Presets').click();
  await expect(page.locator('#presets')).toBeVisible();
  // A material with a mark on it, a part that is hidden, all that folds unfolded, and an error to read.
  await page.locator('[data-preset=blackboard]').click();
  await tab(page, 'Scene');
  await page.locator('#parts .eye').first().click();
  await page.evaluate(() => document.querySelectorAll('details').forEach((details) => (details.open = true)));
  await drop(page, [{ name: 'bad.glb', bytes: Buffer.from('no model') }]);
  await expect(page.getByRole('alert').first()).toBeVisible();
  const faults: string[] = [];
  const look = async (what: string) => {
    for (const fault of await checkAccessibility(page)) faults.push(`${what}: ${fault}`);
    const wider = await page.evaluate(
      () => document.documentElement.scrollWidth - document.documentElement.clientWidth,
    );
    if (wider > 0) faults.push(`${what}: ${wider} pixels wider than the window`);
  };
  // With GLANZ_FULL each size in each theme, with every menu and every light; else these alternately, all menus on a phone.
  const full = process.env['GLANZ_FULL'] !== undefined;
  const themes = (chosen: 'light' | 'dark') => (full ? (['light', 'dark'] as const) : [chosen]);
  for (const [width, height, chosen] of [
    [1440, 900, 'dark'],
    [820, 1100, 'light'],
    [360, 740, 'dark'],
  ] as const) {
    for (const scheme of themes(chosen)) {
      const at = (what: string) => `${what} at ${width}, ${scheme}`;
      await page.emulateMedia({ colorScheme: scheme });
      await page.setViewportSize({ width, height });
      const narrow = await page.locator('#tab-scene').isVisible();
      for (const name of [...(narrow ? (['Scene'] as const) : []), 'Material', 'Light', 'Camera', 'Render'] as const) {
        await tab(page, name);
        await look(at(name));
      }
      await tab(page, 'Light');
      for (const [from, background, sizes] of [
        ['constant', 'color', [1440]],
        ['none', 'blurred', [820]],
        ['studio', 'environment', [1440, 820]],
      ] as const) {
        if (!full && !sizes.some((size) => size === width)) continue;
        await page.getByLabel('Light from', { exact: true }).selectOption(from);
        await page.getByLabel('Background', { exact: true }).selectOption(background);
        if (from !== 'studio') await look(at(`light from ${from}`));
      }
      for (const [menu, sizes] of [
        ['share', [1440, 360]],
        ['export', [820, 360]],
      ] as const) {
        if (!full && !sizes.some((size) => size === width)) continue;
        await page.locator(`#${menu}`).click();
        await expect(page.locator(`#${menu}-menu`)).toBeVisible();
        await look(at(menu));
        await page.keyboard.press('Escape');
      }
      await page.locator('#help').click();
      await look(at('keys'));
      await page.keyboard.press('Escape');
    }
  }
  expect(faults).toEqual([]);
});

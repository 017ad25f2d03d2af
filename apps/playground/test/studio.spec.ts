import { expect, test, type Page } from '@playwright/test';
import {
  checkAccessibility,
  dataOf,
  drop,
  finished,
  imageOf,
  onePage,
  open,
  overlap,
  photograph,
  restarting,
  watch,
} from './page';

/** One page for all: each test leaves the model, and closes what it opened. */
let page: Page;

onePage({ width: 900, height: 560 }, 'model=cornell-box&scale=0.125&samples=1&max-depth=2', async (opened) => {
  page = opened;
  await finished(page);
});

const SIZES = [
  [1440, 900, 'dark'],
  [900, 560, 'light'],
  [360, 740, 'dark'],
] as const;

/** What is seen at three sizes: no faults of accessibility, nothing wider than the window. */
async function atAllSizes(what: string, check: () => Promise<void> = async () => undefined): Promise<void> {
  const faults: string[] = [];
  for (const [width, height, colorScheme] of SIZES) {
    await page.setViewportSize({ width, height });
    await page.emulateMedia({ colorScheme });
    for (const fault of await checkAccessibility(page)) faults.push(`${what} at ${width}, ${colorScheme}: ${fault}`);
    const wider = await page.evaluate(
      () => document.documentElement.scrollWidth - document.documentElement.clientWidth,
    );
    if (wider > 0) faults.push(`${what} at ${width}: ${wider} pixels wider than the window`);
    await check();
    if (process.env['GLANZ_SCREENSHOTS'])
      await page.screenshot({ path: `${process.env['GLANZ_SCREENSHOTS']}/${what}-${width}.png` });
  }
  await page.setViewportSize({ width: 900, height: 560 });
  await page.emulateMedia({ colorScheme: 'light' });
  expect(faults).toEqual([]);
}

/** Width of the narrowest thumbnail that is shown. */
const narrowest = () =>
  page
    .locator('.thumbnail:visible')
    .evaluateAll((all) => Math.min(...all.map((one) => one.getBoundingClientRect().width)));

test('a look sets studio, light and camera at one click, as one step of undo', async () => {
  const looks = page.getByRole('group', { name: 'Looks' });
  const camera = page.locator('#camera');
  await page.getByRole('button', { name: 'Looks' }).press('Enter');
  await expect(looks.getByRole('button')).toHaveCount(8);
  // The images are there, and the menu leaves the model in sight.
  await expect
    .poll(() =>
      looks
        .locator('img')
        .evaluateAll((images) => images.filter((one) => (one as HTMLImageElement).naturalWidth > 0).length),
    )
    .toBe(8);
  await atAllSizes('looks', async () => {
    expect(await overlap(page, '#looks-menu', '#stage')).toBe(0);
    expect(await narrowest()).toBeGreaterThan(100);
  });
  await finished(page);

  await restarting(page, () => looks.getByRole('button', { name: 'Catalogue' }).press('Enter'));
  const bright = await photograph(imageOf(page));
  await expect(looks.getByRole('button', { name: 'Catalogue' })).toHaveAttribute('aria-pressed', 'true');
  await restarting(page, () => looks.getByRole('button', { name: 'Dark' }).click());
  const dark = await photograph(imageOf(page));
  await expect(looks.getByRole('button', { name: 'Catalogue' })).toHaveAttribute('aria-pressed', 'false');
  await expect(looks.getByRole('button', { name: 'Dark' })).toHaveAttribute('aria-pressed', 'true');
  expect(dark.mean[1]).toBeLessThan(0.6 * bright.mean[1]);
  // Linear 0.012 and 0.014 as sRGB.
  await expect(page.locator('#stage')).toHaveCSS('background-color', 'rgb(29, 29, 31)');
  await page.keyboard.press('Escape');
  await expect(looks).toBeHidden();

  // Controls show what the look has set.
  await expect(page.locator('#floor')).toBeChecked();
  await expect(page.locator('[data-studio=low-key]')).toHaveAttribute('aria-pressed', 'true');
  await expect(camera).toHaveValue('-1');
  await restarting(page, () => page.getByRole('button', { name: 'Undo: Dark' }).click());
  await restarting(page, () => page.getByRole('button', { name: 'Undo: Catalogue' }).click());
  await expect(page.locator('#floor')).not.toBeChecked();
  await expect(page.locator('#environment')).toHaveValue('none');
});

test('files over the page: it names what it opens', async () => {
  const transfer = await page.evaluateHandle(() => {
    const made = new DataTransfer();
    made.items.add(new File([''], 'a.glb'));
    return made;
  });
  await page.dispatchEvent('#stage', 'dragover', { dataTransfer: transfer });
  const overlay = page.locator('#drop');
  await expect(overlay).toBeVisible();
  for (const kind of ['Model', 'Environment', 'Material', 'Texture']) await expect(overlay).toContainText(kind);
  await atAllSizes('drop', async () => {
    const inside = await overlay.evaluate(
      (box) => box.scrollHeight <= box.clientHeight && box.scrollWidth <= box.clientWidth,
    );
    expect(inside).toBe(true);
  });
  await page.dispatchEvent('#stage', 'dragleave', { dataTransfer: transfer });
  await expect(overlay).toBeHidden();
});

test('messages lie beside the image at every size, over menus, and controls scroll out from under them', async () => {
  await drop(page, [{ name: 'bad.glb', bytes: Buffer.from('no model') }]);
  await drop(page, [{ name: 'unknown.xyz', bytes: Buffer.from('no model') }]);
  await expect(page.getByRole('alert')).toHaveCount(2);
  expect(await dataOf(page, 'sample')).toBe('cornell-box');
  await atAllSizes('messages', async () => {
    expect(await overlap(page, '#messages', '#stage')).toBe(0);
    await expect(page.getByRole('alert').last()).toBeInViewport({ ratio: 1 });
  });
  await page.locator('#export').click();
  await drop(page, [{ name: 'other.xyz', bytes: Buffer.from('no model') }]);
  const last = page.getByRole('alert').last();
  await expect(last).toContainText('other.xyz');
  // What is at its middle is the message itself, not the menu.
  const seen = await last.evaluate((message) => {
    const { left, top, width, height } = message.getBoundingClientRect();
    return message.contains(document.elementFromPoint(left + width / 2, top + height / 2));
  });
  expect(seen).toBe(true);
  await page.keyboard.press('Escape');
  while ((await page.getByRole('alert').count()) > 0)
    await page.getByRole('button', { name: 'Close this message' }).first().click();
  await expect(page.locator('#messages')).toBeHidden();
});

test('samples as images: a click loads the model, with the light that it brings', async () => {
  const samples = page.getByRole('group', { name: 'Sample models' });
  await page.getByRole('button', { name: 'Samples' }).press('Enter');
  await expect(samples.getByRole('button')).toHaveCount(17);
  const images = samples.locator('img');
  await expect
    .poll(() => images.evaluateAll((list) => list.filter((one) => (one as HTMLImageElement).naturalWidth === 0).length))
    .toBe(0);
  await expect(samples.getByRole('button', { name: 'Cornell box' })).toHaveAttribute('aria-pressed', 'true');
  await atAllSizes('samples', async () => expect(await narrowest()).toBeGreaterThan(100));
  // A product stands on the floor, a set has its own.
  await samples.getByRole('button', { name: '11 k triangles' }).press('Enter');
  await expect.poll(() => dataOf(page, 'scene')).toBe('Push-button');
  await expect(page.locator('#floor')).toBeChecked();
  await page.getByRole('button', { name: 'Samples' }).click();
  await samples.getByRole('button', { name: 'Knot' }).press('Enter');
  await expect(samples).toBeHidden();
  await expect.poll(() => dataOf(page, 'scene')).toBe('Knot');
  await finished(page);
  expect((await photograph(imageOf(page))).mean[1]).toBeGreaterThan(5);
  await expect(page.locator('#model')).toHaveValue('knot');
  await expect(page.locator('#floor')).not.toBeChecked();
  expect(await page.title()).toContain('Knot');
});

test('code for the renderer, the viewer, a page and React', async () => {
  await page.locator('#share').click();
  const code = page.locator('#snippet');
  for (const [kind, text] of [
    ['Renderer, TypeScript', 'PathTracer.create('],
    ['Viewer, TypeScript', "await viewer.load('/knot.glb')"],
    ['Element, HTML', 'src="/knot.glb"'],
    ['React component', "src={'/knot.glb'}"],
  ] as const) {
    await page.getByLabel('Code for').selectOption({ label: kind });
    await expect(code).toContainText(text);
  }
  await atAllSizes('code');
  await page.keyboard.press('Escape');
});

test('a window that gets wide shows another tab in place of the scene, which is beside the image then', async () => {
  await page.setViewportSize({ width: 360, height: 740 });
  await page.getByRole('tab', { name: 'Scene' }).click();
  await page.setViewportSize({ width: 1440, height: 900 });
  const material = page.getByRole('tab', { name: 'Material' });
  await expect(material).toHaveAttribute('aria-selected', 'true');
  await expect(page.getByRole('tabpanel', { name: 'Material' })).toBeVisible();
  await page.getByRole('tab', { name: 'Camera' }).click();
  await page.setViewportSize({ width: 900, height: 560 });
  await expect(page.getByRole('tab', { name: 'Camera' })).toHaveAttribute('aria-selected', 'true');
  await material.click();
});

test('presets are open from the start on wide screens, and closed on others', async ({ browser }) => {
  const { origin } = new URL(page.url());
  await expect(page.locator('#presets-group')).not.toHaveAttribute('open');
  const wide = await browser.newPage({ viewport: { width: 1440, height: 900 } });
  const said = watch(wide, origin);
  await open(wide, `${origin}/?model=cornell-box&scale=0.125&samples=1&max-depth=2`);
  await expect(wide.locator('#presets .preset')).toHaveCount(83);
  for (const colorScheme of ['light', 'dark'] as const) {
    await wide.emulateMedia({ colorScheme });
    await expect(wide.locator('#presets img').first()).toBeVisible();
    expect(await checkAccessibility(wide), colorScheme).toEqual([]);
    if (process.env['GLANZ_SCREENSHOTS'])
      await wide.screenshot({ path: `${process.env['GLANZ_SCREENSHOTS']}/presets-1440-${colorScheme}.png` });
  }
  expect(said).toEqual([]);
  await wide.close();
});

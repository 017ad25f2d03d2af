import { readFileSync } from 'node:fs';
import { test } from '@glanz/browser/shared-device';
import { expect, type Page } from '@playwright/test';
import {
  checkAccessibility,
  errorWith,
  imageOf,
  overlap,
  plain,
  pixelsOf,
  renderToFile,
  servePlayground,
  watch,
  type RenderSettings,
  themesAt,
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

async function open(page: Page, code = '', query = 'level=low&scale=0.125&samples=6&max-depth=3'): Promise<void> {
  await page.goto(plain(`${origin}/configurator.html?${query}${code}`));
  await expect(page.locator('#stage')).toHaveAttribute('data-ready', '');
  await done(page);
}

async function done(page: Page): Promise<void> {
  await expect(imageOf(page)).toHaveAttribute('data-state', 'done');
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
}

/** Does something that changes a finished image, and waits for the next one. */
async function changing(page: Page, action: () => Promise<unknown>): Promise<void> {
  const begun = await imageOf(page).evaluateHandle((image) => {
    const seen = { change: false };
    new MutationObserver(() => (seen.change = true)).observe(image, { attributeFilter: ['data-state'] });
    return seen;
  });
  await action();
  await expect.poll(() => begun.evaluate((seen) => seen.change), { message: 'the image changes' }).toBe(true);
  await done(page);
}

/** Looks at the button from the front. */
const lookFromFront = (page: Page) => changing(page, () => page.getByRole('button', { name: 'Front' }).click());

/** Does something that changes the button, and waits for its cost and the finished image. */
async function choosing(page: Page, action: () => Promise<unknown>): Promise<void> {
  // It may cost the same as the change before.
  await imageOf(page).evaluate((image) => delete image.dataset['price']);
  await changing(page, async () => {
    await action();
    await expect(imageOf(page), 'the cost of the change is shown').toHaveAttribute('data-price', /\d/);
  });
}

const choose = (page: Page, id: string) => choosing(page, () => page.locator(`#${id}`).check({ force: true }));

/** Saves the image by the dialog, at a quarter of the canvas's size. */
async function saveImage(page: Page, settings: Partial<RenderSettings> = {}) {
  const [width, height] = await imageOf(page).evaluate((canvas) =>
    [canvas.clientWidth, canvas.clientHeight].map((side) => Math.round(side / 4)),
  );
  await page.getByRole('button', { name: 'Save image' }).click();
  return renderToFile(page, { width: width!, height: height!, ...settings });
}

/**
 * Of the saved image: the share of pixels that the button covers, and of those the shares that are clearly red,
 * green.
 */
async function shares(page: Page): Promise<{ readonly covered: number; readonly red: number; readonly green: number }> {
  const download = await saveImage(page);
  return page.evaluate(
    async (base64) => {
      const bitmap = await createImageBitmap(
        new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: 'image/png' }),
      );
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d')!;
      context.drawImage(bitmap, 0, 0);
      const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
      let [covered, red, green] = [0, 0, 0];
      for (let i = 0; i < data.length; i += 4) {
        if (data[i + 3]! < 128) continue;
        const [r, g] = [data[i]!, data[i + 1]!];
        covered++;
        if (r > 1.5 * g && r > 60) red++;
        if (g > 1.3 * r && g > 60) green++;
      }
      return { covered: covered / (data.length / 4), red: red / covered, green: green / covered };
    },
    readFileSync(await download.path()).toString('base64'),
  );
}

test('a button is put together: each click changes the image, the sentence, the code and the address', async ({
  page,
}) => {
  await open(page);
  await expect(page.locator('#code')).toHaveValue('GB22-FG-P-RC-G-PA-C');
  await expect(page.locator('#sentence')).toContainText('Flush push-button in green with the power sign, lit in green');
  await lookFromFront(page);
  const green = await shares(page);
  expect(green.green).toBeGreaterThan(0.06);
  expect(green.red).toBeLessThan(0.03);

  await choose(page, 'colour-R');
  await choose(page, 'light-R');
  const red = await shares(page);
  expect(red.red).toBeGreaterThan(0.06);
  expect(red.green).toBeLessThan(0.01);
  await expect(page.locator('#code')).toHaveValue('GB22-FR-P-RC-R-PA-C');
  await expect(page.locator('#price')).toContainText(/\d+ ms/);
  expect(new URL(page.url()).hash).toBe('#GB22-FR-P-RC-R-PA-C');

  // Without a panel there is less to see, and its finish has nothing to say.
  await choose(page, 'mounting-N');
  expect((await shares(page)).covered).toBeLessThan(0.75 * red.covered);
  await expect(page.locator('#panel-A')).toBeDisabled();
  await choose(page, 'mounting-P');
  expect(Math.abs((await shares(page)).covered - red.covered)).toBeLessThan(0.01);

  // A mushroom covers the bezel, and is red where that was chrome.
  await choose(page, 'shape-M');
  expect((await shares(page)).red).toBeGreaterThan(1.5 * red.red);
  await expect(page.locator('#sentence')).toContainText('Mushroom push-button in red');
});

test('a link, or a code typed in, is that button; a wrong code is marked and changes nothing', async ({ page }) => {
  await open(page, '#GB22-RB-H-QK-N-EY-O');
  await expect(page.locator('#sentence')).toContainText(
    'Raised push-button in blue with the stop sign, without illumination, black chrome square bezel, in an enclosure lid in safety yellow',
  );
  await expect(page.locator('#mounting-E')).toBeChecked();
  await lookFromFront(page);
  const corner = async () => {
    const box = (await imageOf(page).boundingBox())!;
    return (
      await pixelsOf(
        page,
        await page.screenshot({
          clip: { x: box.x + box.width / 2 - 120, y: box.y + box.height / 2 - 120, width: 12, height: 12 },
        }),
      )
    ).mean;
  };
  const yellow = await corner();
  expect(yellow[0]).toBeGreaterThan(2 * yellow[2]);

  await page.locator('#code').fill('GB22-nonsense');
  await page.locator('#code').press('Enter');
  await expect(page.locator('#code')).toHaveAttribute('aria-invalid', 'true');
  await expect(page.locator('#mounting-E')).toBeChecked();
  await page.locator('#code').fill('gb22-wk-n-sw-n-dg-x');
  await page.locator('#code').press('Enter');
  await expect(page.locator('#code')).toHaveAttribute('aria-invalid', 'true');
  await choosing(page, async () => {
    await page.locator('#code').fill('gb22-fk-n-sw-n-eg-x');
    await page.locator('#code').press('Enter');
  });
  await expect(page.locator('#sentence')).toContainText('Flush push-button in black');
  const grey = await corner();
  expect(Math.abs(grey[0] - grey[2])).toBeLessThan(20);
});

test('the page keeps its image when its size changes, saves it, and has no accessibility faults at three sizes', async ({
  page,
}) => {
  await open(page);
  for (const [width, height] of [
    [1440, 900],
    [820, 1100],
    [360, 740],
  ] as const) {
    await page.setViewportSize({ width, height });
    await expect
      .poll(
        async () =>
          await imageOf(page).evaluate((canvas: HTMLCanvasElement) =>
            Math.abs(canvas.width / canvas.height - canvas.clientWidth / canvas.clientHeight),
          ),
      )
      .toBeLessThan(0.05);
    await done(page);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
    for (const scheme of themesAt(width)) {
      await page.emulateMedia({ colorScheme: scheme });
      expect(await checkAccessibility(page), `${scheme} at ${width}`).toEqual([]);
    }
  }
  await page.setViewportSize({ width: 900, height: 560 });
  // A button that stands out keeps its contrast below the pointer.
  await page.getByRole('button', { name: 'Save image' }).hover();
  for (const scheme of themesAt(900)) {
    await page.emulateMedia({ colorScheme: scheme });
    expect(await checkAccessibility(page), `the pointer on the button, ${scheme}`).toEqual([]);
  }
  const jpeg = await saveImage(page, { width: 48, height: 32, samples: 2, format: 'JPEG' });
  expect(jpeg.suggestedFilename()).toBe('gb22-fg-p-rc-g-pa-c.jpg');
  const { width, height } = await pixelsOf(page, readFileSync(await jpeg.path()));
  expect([width, height]).toEqual([48, 32]);
  await page.getByRole('button', { name: 'Save image' }).click();
  for (const scheme of themesAt(1440)) {
    await page.emulateMedia({ colorScheme: scheme });
    expect(await checkAccessibility(page), `the dialog, ${scheme}`).toEqual([]);
    if (process.env['GLANZ_SCREENSHOTS'])
      await page.screenshot({ path: `${process.env['GLANZ_SCREENSHOTS']}/configurator-${scheme}.png` });
  }
  await page.keyboard.press('Escape');
  const download = await saveImage(page);
  expect(download.suggestedFilename()).toBe('gb22-fg-p-rc-g-pa-c.png');
  const { deviation, colours } = await pixelsOf(page, readFileSync(await download.path()));
  expect(colours).toBeGreaterThan(500);
  expect(deviation).toBeGreaterThan(20);
});

test('messages lie over the options and never over the product; the last option scrolls out from under them', async ({
  page,
}) => {
  // The note stays until the test has looked at it.
  await page.addInitScript(() => {
    const later = window.setTimeout;
    window.setTimeout = ((run: TimerHandler, ms?: number, ...rest: unknown[]) =>
      ms === 9000 ? 0 : later(run, ms, ...rest)) as typeof window.setTimeout;
  });
  await open(page);
  await page.getByRole('button', { name: 'Copy link' }).click();
  const message = page.locator('.message');
  await expect(message).toContainText('The link to this button');
  for (const [width, height] of [
    [1440, 900],
    [900, 560],
    [360, 740],
  ] as const) {
    await page.setViewportSize({ width, height });
    for (const scheme of themesAt(width)) {
      await page.emulateMedia({ colorScheme: scheme });
      expect(await overlap(page, '.message', '#stage'), `over the product at ${width}`).toBe(0);
      expect(await overlap(page, '.message', 'footer'), `over the order at ${width}`).toBe(0);
      await expect(message).toBeInViewport({ ratio: 1 });
      await page.locator('aside').evaluate((aside) => aside.scrollTo(0, aside.scrollHeight));
      expect(await overlap(page, '.message', 'aside .small:last-of-type'), `over the options at ${width}`).toBe(0);
      expect(await checkAccessibility(page), `${scheme} at ${width}`).toEqual([]);
      if (process.env['GLANZ_SCREENSHOTS'])
        await page.screenshot({ path: `${process.env['GLANZ_SCREENSHOTS']}/message-${width}-${scheme}.png` });
    }
  }
});

test('without WebGPU the page says so', async ({ page }) => {
  await page.addInitScript(() => Object.defineProperty(navigator, 'gpu', { value: undefined, configurable: true }));
  await page.goto(`${origin}/configurator.html?level=low`);
  await expect(page.getByRole('heading', { name: 'This page needs WebGPU' })).toBeVisible();
  await expect(errorWith(page, 'renderer/no-webgpu').first()).toBeVisible();
});

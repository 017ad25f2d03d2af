import { readFileSync } from 'node:fs';
import { test } from '@glanz/browser/shared-device';
import { expect, type Page } from '@playwright/test';
import { dataOf, finished, imageOf, open as openAt, pixelsOf, save, servePlayground, tab, watch } from './page';

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

const status = (page: Page) => page.locator('#status').innerText();

/** Whether the image on the screen is denoised, once it has all its samples. */
async function expectDenoised(page: Page, denoised: boolean): Promise<void> {
  await expect(imageOf(page)).toHaveAttribute('data-denoised', String(denoised));
  await finished(page);
  expect(await status(page)).toContain(denoised ? 'done · denoised' : 'done');
  if (!denoised) expect(await status(page)).not.toContain('denoised');
}

/**
 * How much neighbouring pixels of the back wall, whose colour changes slowly, differ: mean of the absolute differences of
 * green, film pixel by film pixel.
 */
async function noise(page: Page, image?: Buffer): Promise<number> {
  const box = (await imageOf(page).boundingBox())!;
  const png = image ?? (await page.screenshot({ clip: box }));
  return page.evaluate(
    async ([base64, step]) => {
      const bitmap = await createImageBitmap(
        new Blob([Uint8Array.from(atob(base64 as string), (c) => c.charCodeAt(0))], { type: 'image/png' }),
      );
      const { width, height } = bitmap;
      const context = new OffscreenCanvas(width, height).getContext('2d')!;
      context.drawImage(bitmap, 0, 0);
      const { data } = context.getImageData(0, 0, width, height);
      let [sum, count] = [0, 0];
      const by = step as number;
      for (let y = Math.round(0.3 * height); y < 0.5 * height; y += by)
        for (let x = Math.round(0.55 * width); x < 0.7 * width; x += by, count++)
          sum += Math.abs(data[4 * (y * width + x) + 1]! - data[4 * (y * width + x + by) + 1]!);
      return sum / count;
    },
    [png.toString('base64'), image ? 1 : 4] as const,
  );
}

test('images of few samples are denoised, on the screen and in PNG files, until that is switched off', async ({
  page,
}) => {
  await openAt(page, `${origin}/?model=cornell-box&scale=0.125&samples=4&max-depth=3&denoise=on`);
  await expectDenoised(page, true);
  const denoised = await noise(page);
  const look = async (name: string) => {
    if (process.env['GLANZ_SCREENSHOTS'])
      await page.screenshot({ path: `${process.env['GLANZ_SCREENSHOTS']}/${name}.png` });
  };
  await tab(page, 'Render');
  await look('denoised');
  const saved = readFileSync(await (await save(page, 'Save PNG')).path());
  expect(saved.includes('Denoised\0Open Image Denoise')).toBe(true);
  const [restarts, samples] = [await dataOf(page, 'restarts'), await dataOf(page, 'samples')];

  // A layer is no denoised image.
  await page.getByLabel('Layer', { exact: true }).selectOption('normal');
  await expect.poll(() => status(page)).not.toContain('denoised');
  await page.getByLabel('Layer', { exact: true }).selectOption('beauty');
  await expectDenoised(page, true);

  await page.getByRole('checkbox', { name: 'Denoise' }).uncheck();
  await expectDenoised(page, false);
  await look('noisy');
  const noisy = await noise(page);
  expect(noisy).toBeGreaterThan(4);
  expect(denoised).toBeLessThan(0.4 * noisy);
  const film = readFileSync(await (await save(page, 'Save PNG')).path());
  expect(film.includes('Denoised')).toBe(false);
  expect(await noise(page, saved)).toBeLessThan(0.4 * (await noise(page, film)));
  // Nothing else has changed: colours, and the samples that there are.
  const [before, after] = [await pixelsOf(page, saved), await pixelsOf(page, film)];
  after.mean.forEach((mean, k) => expect(Math.abs(mean - before.mean[k]!)).toBeLessThan(4));
  expect([await dataOf(page, 'restarts'), await dataOf(page, 'samples')]).toEqual([restarts, samples]);

  // A step of the history, as other options are.
  await page.getByRole('button', { name: 'Undo: Denoise' }).click();
  await expectDenoised(page, true);
  await expect(page.getByRole('checkbox', { name: 'Denoise' })).toBeChecked();
});

test('the configurator denoises its image', async ({ page }) => {
  // By the same engine as above.
  test.skip(process.env['GLANZ_FULL'] === undefined, 'with --full');
  await page.goto(`${origin}/configurator.html?level=low&scale=0.125&samples=4&max-depth=3`);
  await expect(imageOf(page)).toHaveAttribute('data-denoised', 'true');
  await finished(page);
  expect(await dataOf(page, 'denoised')).toBe('true');
  if (process.env['GLANZ_SCREENSHOTS'])
    await page.screenshot({ path: `${process.env['GLANZ_SCREENSHOTS']}/configurator-denoised.png` });
});

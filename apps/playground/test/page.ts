import { fileURLToPath } from 'node:url';
import { photograph as photographAll, serveApp, watch, type Pixels, type Served } from '@glanz/browser';
import { expect, test, type Download, type Locator, type Page } from '@playwright/test';

export { checkAccessibility, pixelsOf, watch } from '@glanz/browser';

/** The built page, served on a free port of this machine. */
export const servePlayground = (): Promise<Served> => serveApp(fileURLToPath(new URL('..', import.meta.url)));

/** What lies over the image does not belong to it. */
const ALONE = '.status, .messages, .tools, #outline { visibility: hidden } #image { outline: none !important }';

/** The canvas as the browser's window shows it. */
export const photograph = (canvas: Locator): Promise<Pixels> => photographAll(canvas, ALONE);

/** Drops files on the page as a user would. */
export async function drop(
  page: Page,
  files: readonly { readonly name: string; readonly bytes: Buffer }[],
): Promise<void> {
  const transfer = await page.evaluateHandle(
    (list) => {
      const made = new DataTransfer();
      for (const { name, base64 } of list)
        made.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name));
      return made;
    },
    files.map(({ name, bytes }) => ({ name, base64: bytes.toString('base64') })),
  );
  await page.dispatchEvent('#stage', 'dragover', { dataTransfer: transfer });
  await page.dispatchEvent('#stage', 'drop', { dataTransfer: transfer });
}

/** Themes to look at in a window of a width: with GLANZ_FULL both, else one of them, another one for the next width. */
export function themesAt(width: number): readonly ('light' | 'dark')[] {
  if (process.env['GLANZ_FULL'] !== undefined) return ['light', 'dark'];
  return [width > 500 && width < 1000 ? 'light' : 'dark'];
}

export const imageOf = (page: Page): Locator => page.locator('#image');

/** An attribute `data-…` of the image's canvas, or nothing. */
export const dataOf = async (page: Page, name: string): Promise<string> =>
  (await imageOf(page).getAttribute(`data-${name}`)) ?? '';

/** An address of which images are shown as the film has them, without a floor, unless it says otherwise. */
export function plain(address: string): string {
  const url = new URL(address);
  for (const name of ['denoise', 'floor']) if (!url.searchParams.has(name)) url.searchParams.set(name, 'off');
  return url.href;
}

/** Opens the page and waits for a scene and its controls. */
export async function open(page: Page, address: string): Promise<void> {
  await page.goto(plain(address));
  // Where none comes, the messages of the page say why.
  const shown = async () =>
    (await dataOf(page, 'scene')) === ''
      ? (await page.locator('.status, .messages').allInnerTexts()).join(' ').replace(/\s+/g, ' ')
      : 'a scene';
  await expect.poll(shown, { message: 'a scene is shown' }).toBe('a scene');
  await expect(page.locator('body')).toHaveAttribute('data-panels', 'ready');
}

/**
 * One page for all tests of a file. It is opened before the first one and closed after the last one; what the browser
 * complains of fails the test in which it does.
 *
 * @param query What follows the `?` of the address.
 * @param ready Gets the page with its scene and controls.
 */
export function onePage(
  viewport: { readonly width: number; readonly height: number },
  query: string,
  ready: (page: Page) => Promise<void> | void,
): void {
  let page: Page | undefined;
  let close: () => Promise<void> = async () => undefined;
  let complaints: readonly string[] = [];
  test.beforeAll(async ({ browser }) => {
    const served = await servePlayground();
    close = served.close;
    page = await browser.newPage({ viewport });
    complaints = watch(page, served.origin);
    await open(page, `${served.origin}/?${query}`);
    await ready(page);
  });
  test.afterEach(() => expect(complaints).toEqual([]));
  test.afterAll(async () => {
    // Undefined where the browser had no page to give.
    await page?.close();
    await close();
  });
}

/**
 * Waits in the page itself until a `data-…` attribute of the image is as expected, or 55 s: what Playwright asks for
 * repeatedly it sees up to a second late, in which a core is idle. What then is not so, the caller's `expect` reports.
 */
const untilData = (page: Page, name: string, expected: { readonly is: string } | { readonly above: number }) =>
  page.evaluate(
    async ([key, goal]) => {
      const end = performance.now() + 55_000;
      const reached = () => {
        const value = document.querySelector('#image')?.getAttribute(`data-${key}`) ?? '';
        return 'is' in goal ? value === goal.is : Number(value) > goal.above;
      };
      while (!reached() && performance.now() < end) await new Promise((resolve) => setTimeout(resolve, 30));
    },
    [name, expected] as const,
  );

/**
 * Waits for an image with all its samples, of what the page has been asked for until now. It begins that in the next
 * turn of its event loop, or with the next frame of the screen where that is a size, and until then it is still done
 * with the image before. The last draw comes with the next frame, too.
 */
export async function finished(page: Page): Promise<void> {
  await page.evaluate(async () => {
    const end = performance.now() + 55_000;
    const { dataset } = document.querySelector<HTMLElement>('#image')!;
    const turn = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));
    while (performance.now() < end) {
      const restarts = dataset['restarts'];
      if (dataset['state'] !== 'done') await turn(30);
      else {
        await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
        await turn(0);
        if (dataset['state'] === 'done' && dataset['restarts'] === restarts) return;
      }
    }
  });
  await expect(imageOf(page)).toHaveAttribute('data-state', 'done');
}

/** Does something that restarts the film, and waits for the new image. */
export async function restarting(page: Page, action: () => Promise<unknown>): Promise<void> {
  const before = Number(await dataOf(page, 'restarts'));
  await action();
  await untilData(page, 'restarts', { above: before });
  await expect
    .poll(async () => Number(await dataOf(page, 'restarts')), { message: 'the film starts again' })
    .toBeGreaterThan(before);
  await finished(page);
}

export const errorWith = (page: Page, code: string): Locator => page.locator(`[role=alert][data-code="${code}"]`);

/** Shows one of the panels beside the image. */
export const tab = (page: Page, name: 'Scene' | 'Material' | 'Light' | 'Camera' | 'Render'): Promise<void> =>
  page.getByRole('tab', { name }).click();

/** Settings of the dialog for images, by the ids of its controls. */
export interface RenderSettings {
  readonly width: number;
  readonly height: number;
  readonly samples?: number;
  readonly format?: string;
  readonly transparent?: boolean;
}

/** Fills the open dialog. */
export async function fillRenderDialog(
  page: Page,
  { width, height, samples, format, transparent }: RenderSettings,
): Promise<void> {
  await page.getByLabel('Width, pixels').fill(String(width));
  await page.getByLabel('Height, pixels').fill(String(height));
  if (samples !== undefined) await page.getByRole('spinbutton', { name: 'Samples per pixel' }).fill(String(samples));
  if (format !== undefined) await page.getByLabel('Format').selectOption({ label: format });
  if (transparent !== undefined) await page.getByLabel('Transparent background').setChecked(transparent);
}

/** Renders with the open dialog, to a file, and closes it. */
export async function renderToFile(page: Page, settings: RenderSettings): Promise<Download> {
  await fillRenderDialog(page, settings);
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    page.getByRole('button', { name: 'Save file' }).click(),
  ]);
  await page.getByRole('dialog').getByRole('button', { name: 'Close' }).click();
  return download;
}

/** Saves something by the export menu. */
export async function save(page: Page, name: string): Promise<Download> {
  if (!(await page.locator('#export-menu').isVisible())) await page.locator('#export').click();
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    page.getByRole('button', { name: new RegExp(`^${name}`) }).click(),
  ]);
  await page.keyboard.press('Escape');
  return download;
}

/** Pixels that two elements have in common. */
export const overlap = (page: Page, one: string, other: string): Promise<number> =>
  page.evaluate(
    (selectors) => {
      const [a, b] = selectors.map((selector) => document.querySelector(selector)!.getBoundingClientRect()) as [
        DOMRect,
        DOMRect,
      ];
      return (
        Math.max(0, Math.min(a.right, b.right) - Math.max(a.left, b.left)) *
        Math.max(0, Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top))
      );
    },
    [one, other],
  );

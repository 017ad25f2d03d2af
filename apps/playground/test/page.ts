import { fileURLToPath } from 'node:url';
import { expect, type Download, type Locator, type Page } from '@playwright/test';
import { build, preview } from 'vite';

const root = fileURLToPath(new URL('..', import.meta.url));

/** The built page, served on a free port of this machine. */
export async function servePlayground(): Promise<{ readonly origin: string; readonly close: () => Promise<void> }> {
  await build({ root, logLevel: 'error' });
  const server = await preview({ root, logLevel: 'error', preview: { host: '127.0.0.1', port: 4173, strictPort: false, open: false } });
  const origin = server.resolvedUrls?.local[0]?.replace(/\/$/, '');
  if (!origin) throw new Error('The preview server has no address.');
  return { origin, close: () => server.close() };
}

/** Collects errors of the page, and requests that leave this machine. */
export function watch(page: Page, origin: string): string[] {
  const complaints: string[] = [];
  page.on('console', (message) => {
    if (message.type() === 'error' || message.type() === 'warning') complaints.push(`${message.type()}: ${message.text()}`);
  });
  page.on('pageerror', (error) => complaints.push(`uncaught: ${error.message}`));
  page.on('request', (request) => {
    if (!request.url().startsWith(origin) && !/^(data|blob):/.test(request.url())) complaints.push(`asks the network for ${request.url()}`);
  });
  return complaints;
}

/** What a picture's pixels look like, in sRGB codes. */
export interface Pixels {
  readonly width: number;
  readonly height: number;
  readonly mean: readonly [number, number, number];
  /** Standard deviation of all codes. */
  readonly deviation: number;
  /** Distinct colours. */
  readonly colours: number;
  /** Mean RGB of the nine cells of a 3 × 3 grid, row by row. */
  readonly cells: readonly (readonly [number, number, number])[];
}

/** Decodes a PNG in the page's own browser and counts. */
export function pixelsOf(page: Page, png: Buffer): Promise<Pixels> {
  return page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const { width, height } = bitmap;
    const context = new OffscreenCanvas(width, height).getContext('2d')!;
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    const cells = Array.from({ length: 9 }, () => [0, 0, 0, 0] as [number, number, number, number]);
    const colours = new Set<number>();
    let [sum, squares] = [0, 0];
    for (let y = 0, i = 0; y < height; y++) {
      for (let x = 0; x < width; x++, i += 4) {
        const [r, g, b] = [data[i]!, data[i + 1]!, data[i + 2]!];
        const cell = cells[Math.floor((3 * y) / height) * 3 + Math.floor((3 * x) / width)]!;
        cell[0] += r;
        cell[1] += g;
        cell[2] += b;
        cell[3]++;
        colours.add((r << 16) | (g << 8) | b);
        sum += r + g + b;
        squares += r * r + g * g + b * b;
      }
    }
    const count = width * height * 3;
    const total = (channel: 0 | 1 | 2) => cells.reduce((all, cell) => all + cell[channel], 0) / (width * height);
    return {
      width,
      height,
      mean: [total(0), total(1), total(2)] as [number, number, number],
      deviation: Math.sqrt(Math.max(0, squares / count - (sum / count) ** 2)),
      colours: colours.size,
      cells: cells.map(([r, g, b, n]) => [r / n, g / n, b / n] as [number, number, number]),
    };
  }, png.toString('base64'));
}

/** What lies over the picture does not belong to it. */
const ALONE = '.status, .messages, .tools, #outline { visibility: hidden } #picture { outline: none !important }';

/** The canvas as the browser's window shows it. */
export const photograph = async (canvas: Locator): Promise<Pixels> => pixelsOf(canvas.page(), await canvas.screenshot({ style: ALONE }));

/** Drops files on the page as a hand would. */
export async function drop(page: Page, files: readonly { readonly name: string; readonly bytes: Buffer }[]): Promise<void> {
  const transfer = await page.evaluateHandle((list) => {
    const made = new DataTransfer();
    for (const { name, base64 } of list) made.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name));
    return made;
  }, files.map(({ name, bytes }) => ({ name, base64: bytes.toString('base64') })));
  await page.dispatchEvent('#stage', 'dragover', { dataTransfer: transfer });
  await page.dispatchEvent('#stage', 'drop', { dataTransfer: transfer });
}

export const pictureOf = (page: Page): Locator => page.locator('#picture');

/** An attribute `data-…` of the picture's canvas, or nothing. */
export const dataOf = async (page: Page, name: string): Promise<string> => (await pictureOf(page).getAttribute(`data-${name}`)) ?? '';

/** Opens the page and waits for a scene and its controls. */
export async function open(page: Page, address: string): Promise<void> {
  await page.goto(address);
  await expect.poll(() => dataOf(page, 'scene'), { message: 'a scene is shown' }).not.toBe('');
  await expect(page.locator('body')).toHaveAttribute('data-panels', 'ready');
}

/** Waits for a picture with all its samples. */
export async function finished(page: Page): Promise<void> {
  await expect(pictureOf(page)).toHaveAttribute('data-state', 'done');
  // The last draw comes with the next frame of the screen.
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
}

/** Does something that restarts the film, and waits for the new picture. */
export async function restarting(page: Page, action: () => Promise<unknown>): Promise<void> {
  const before = Number(await dataOf(page, 'restarts'));
  await action();
  await expect.poll(async () => Number(await dataOf(page, 'restarts')), { message: 'the film starts anew' }).toBeGreaterThan(before);
  await finished(page);
}

export const errorWith = (page: Page, code: string): Locator => page.locator(`[role=alert][data-code="${code}"]`);

/** Shows one of the panels beside the picture. */
export const tab = (page: Page, name: 'Scene' | 'Material' | 'Light' | 'Camera' | 'Render'): Promise<void> => page.getByRole('tab', { name }).click();

/** Saves something by the export menu. */
export async function save(page: Page, name: string): Promise<Download> {
  if (!(await page.locator('#export-menu').isVisible())) await page.locator('#export').click();
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: new RegExp(`^${name}`) }).click()]);
  await page.keyboard.press('Escape');
  return download;
}

/** Faults that axe finds in the page as it is: its rule and the element, one line each. */
export async function checkAccessibility(page: Page): Promise<string[]> {
  if (!(await page.evaluate(() => 'axe' in globalThis))) await page.addScriptTag({ path: fileURLToPath(import.meta.resolve('axe-core/axe.min.js')) });
  return page.evaluate(async () => {
    const { axe } = globalThis as unknown as { axe: { run(context: Document, options: object): Promise<{ violations: { id: string; nodes: { target: string[]; failureSummary: string }[] }[] }> } };
    const { violations } = await axe.run(document, { resultTypes: ['violations'] });
    return violations.flatMap(({ id, nodes }) => nodes.map(({ target, failureSummary }) => `${id}: ${target.join(' ')}: ${failureSummary.split('\n')[1]?.trim() ?? ''}`));
  });
}

import type { Locator, Page } from '@playwright/test';

/** What an image's pixels look like, in sRGB codes. */
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
  /** Shares of pixels by the channel that leads by more than 16 codes. */
  readonly leading: { readonly red: number; readonly green: number; readonly blue: number };
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
    const leading = { red: 0, green: 0, blue: 0 };
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
        if (r > Math.max(g, b) + 16) leading.red += 4 / data.length;
        if (g > Math.max(r, b) + 16) leading.green += 4 / data.length;
        if (b > Math.max(r, g) + 16) leading.blue += 4 / data.length;
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
      leading,
    };
  }, png.toString('base64'));
}

/** An element as the browser's window shows it. */
export const photograph = async (element: Locator, style = ''): Promise<Pixels> =>
  pixelsOf(element.page(), await element.screenshot({ style }));

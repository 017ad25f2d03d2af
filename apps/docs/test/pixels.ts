import type { Locator } from '@playwright/test';

/** What the pixels of a picture on the screen look like. */
export interface PixelStatistics {
  /** Mean of all sRGB codes, 0..255. */
  readonly mean: number;
  /** Standard deviation of the codes; 0 for one colour. */
  readonly deviation: number;
  /** Distinct RGB colours. */
  readonly colours: number;
  /** Share of pixels by the channel that leads by more than 16 codes. */
  readonly leading: { readonly red: number; readonly green: number; readonly blue: number };
}

/** Photographs an element as the browser shows it, and counts its pixels. */
export async function pixelStatistics(target: Locator): Promise<PixelStatistics> {
  const png = (await target.screenshot()).toString('base64');
  return target.page().evaluate(async (base64) => {
    const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob());
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d')!;
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    const colours = new Set<number>();
    const leading = { red: 0, green: 0, blue: 0 };
    let [sum, squares] = [0, 0];
    for (let i = 0; i < data.length; i += 4) {
      const [r, g, b] = [data[i]!, data[i + 1]!, data[i + 2]!];
      sum += r + g + b;
      squares += r * r + g * g + b * b;
      colours.add((r << 16) | (g << 8) | b);
      if (r > Math.max(g, b) + 16) leading.red += 4 / data.length;
      if (g > Math.max(r, b) + 16) leading.green += 4 / data.length;
      if (b > Math.max(r, g) + 16) leading.blue += 4 / data.length;
    }
    const count = (data.length / 4) * 3;
    const mean = sum / count;
    return { mean, deviation: Math.sqrt(squares / count - mean * mean), colours: colours.size, leading };
  }, png);
}

import { readFileSync } from 'node:fs';
import { animatedQuads } from '@glanz/browser';
import { expect, test, type Page } from '@playwright/test';
import { checkAccessibility, dataOf, drop, errorWith, finished, onePage, tab, themesAt } from './page';

/** One page for all, with a model of two squares that change places in 0.2 s, on a colour. */
let page: Page;

onePage({ width: 900, height: 560 }, 'model=cornell-box&scale=0.125&samples=2&max-depth=2', async (opened) => {
  page = opened;
  await drop(page, [{ name: 'quads.glb', bytes: animatedQuads }]);
  await expect.poll(() => dataOf(page, 'scene')).toBe('quads.glb');
  await tab(page, 'Light');
  await page.locator('#background').selectOption('color');
  await page.locator('#environment').selectOption('constant');
  await finished(page);
});

interface Settings {
  readonly motion?: 'Turntable' | 'Animation';
  readonly format: 'MP4' | 'WebM';
  readonly seconds: number;
  readonly fps: number;
}

const dialog = () => page.getByRole('dialog', { name: 'Record video' });

/** Opens the dialog by the keyboard alone. */
async function openDialog(): Promise<void> {
  await page.locator('#export').focus();
  await page.keyboard.press('Enter');
  await page.getByRole('button', { name: /^Record video/ }).press('Enter');
  await expect(dialog()).toBeVisible();
}

async function fill({ motion, format, seconds, fps }: Settings): Promise<void> {
  if (motion) await dialog().getByLabel('Motion', { exact: true }).selectOption(motion);
  await dialog().getByLabel('Format').selectOption({ label: format });
  await dialog().getByLabel('Seconds').fill(String(seconds));
  await dialog().getByLabel('Frames a second').fill(String(fps));
  await dialog().getByLabel('Width, pixels').fill('64');
  await dialog().getByLabel('Height, pixels').fill('48');
  await dialog().getByRole('spinbutton', { name: 'Samples per pixel' }).fill('1');
}

async function record(settings: Settings): Promise<{ readonly name: string; readonly bytes: Buffer }> {
  await fill(settings);
  const [download] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('Enter')]);
  await expect(dialog().getByRole('status')).toContainText('64 × 48, is in your downloads');
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

/** Frames and size of a WebM file, by its EBML elements. */
function webm(bytes: Buffer): { frames: number; width: number; height: number } {
  const found = { frames: 0, width: 0, height: 0 };
  const number = (at: number, length: number) => Number(BigInt(`0x${bytes.subarray(at, at + length).toString('hex')}`));
  // Segment, Tracks, TrackEntry, Video, Cluster, BlockGroup.
  const inside = new Set([0x18538067, 0x1654ae6b, 0xae, 0xe0, 0x1f43b675, 0xa0]);
  const walk = (from: number, to: number) => {
    for (let at = from; at < to;) {
      const idLength = Math.clz32(bytes[at]!) - 23;
      const id = number(at, idLength);
      at += idLength;
      const length = Math.clz32(bytes[at]!) - 23;
      const marker = 2 ** (7 * length);
      const size = number(at, length) - marker;
      at += length;
      const end = size === marker - 1 ? to : at + size;
      if (inside.has(id)) walk(at, end);
      if (id === 0xa3 || id === 0xa1) found.frames++;
      if (id === 0xb0) found.width = number(at, size);
      if (id === 0xba) found.height = number(at, size);
      at = end;
    }
  };
  walk(0, bytes.length);
  return found;
}

/** Frames and size of an MP4 file, by its boxes. */
function mp4(bytes: Buffer): { frames: number; width: number; height: number } {
  const found = { frames: 0, width: 0, height: 0 };
  const walk = (from: number, to: number) => {
    for (let at = from; at + 8 <= to;) {
      const size = bytes.readUInt32BE(at);
      const type = bytes.toString('latin1', at + 4, at + 8);
      if (['moov', 'trak', 'mdia', 'minf', 'stbl'].includes(type)) walk(at + 8, at + size);
      if (type === 'stsz') found.frames += bytes.readUInt32BE(at + 16);
      if (type === 'tkhd') {
        found.width = bytes.readUInt32BE(at + size - 8) / 65536;
        found.height = bytes.readUInt32BE(at + size - 4) / 65536;
      }
      at += size;
    }
  };
  walk(0, bytes.length);
  return found;
}

/** Pixels of the video at times in seconds, as the browser plays it: RGB at points in shares of its size. */
const played = (
  bytes: Buffer,
  type: string,
  times: readonly number[],
  points: readonly (readonly [number, number])[],
) =>
  page.evaluate(
    async ([base64, mime, moments, places]) => {
      const data = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      const video = document.createElement('video');
      video.muted = true;
      video.src = URL.createObjectURL(new Blob([data], { type: mime }));
      await new Promise((resolve, reject) => {
        video.addEventListener('loadeddata', resolve, { once: true });
        video.addEventListener('error', reject, { once: true });
      });
      const context = new OffscreenCanvas(video.videoWidth, video.videoHeight).getContext('2d', {
        willReadFrequently: true,
      })!;
      const frames: number[][][] = [];
      // The event 'seeked' may come before the frame is on the video: the one before would be drawn.
      const presented = (time: number) =>
        new Promise<void>((resolve) => {
          const look = (_: number, { mediaTime }: { readonly mediaTime: number }) =>
            mediaTime <= time + 1e-3 && time - mediaTime < 0.13 ? resolve() : video.requestVideoFrameCallback(look);
          video.requestVideoFrameCallback(look);
        });
      for (const time of moments) {
        const shown = presented(time);
        video.currentTime = time;
        await shown;
        context.drawImage(video, 0, 0);
        frames.push(
          places.map(([x, y]) =>
            Array.from(context.getImageData(x * video.videoWidth, y * video.videoHeight, 1, 1).data.slice(0, 3)),
          ),
        );
      }
      return { duration: video.duration, frames };
    },
    [bytes.toString('base64'), type, times, points] as const,
  );

/** The page's own background colour, linear 0.78, 0.77, 0.75, as sRGB. */
const BACKGROUND = [227, 226, 223];

function expectBackground(pixel: readonly number[] | undefined): void {
  for (const [k, code] of BACKGROUND.entries()) expect(Math.abs((pixel?.[k] ?? 0) - code)).toBeLessThan(6);
}

test('a turntable as WebM: all frames, with the colour behind the model; the image on the screen stays', async () => {
  await openDialog();
  for (const [width, height] of [
    [1440, 900],
    [900, 560],
    [360, 740],
  ] as const) {
    await page.setViewportSize({ width, height });
    for (const colorScheme of themesAt(width)) {
      await page.emulateMedia({ colorScheme });
      expect(await checkAccessibility(page), `${colorScheme} at ${width}`).toEqual([]);
      if (process.env['GLANZ_SCREENSHOTS'])
        await page.screenshot({ path: `${process.env['GLANZ_SCREENSHOTS']}/video-${width}-${colorScheme}.png` });
    }
  }
  await page.setViewportSize({ width: 900, height: 560 });
  await finished(page);
  const [restarts, samples] = [await dataOf(page, 'restarts'), await dataOf(page, 'samples')];
  const { name, bytes } = await record({ motion: 'Turntable', format: 'WebM', seconds: 0.5, fps: 8 });
  expect(name).toBe('quads.webm');
  expect(webm(bytes)).toEqual({ frames: 4, width: 64, height: 48 });
  const { duration, frames } = await played(bytes, 'video/webm', [0.05, 0.2], [[0.02, 0.04]]);
  expect(duration).toBeCloseTo(0.5, 1);
  for (const [corner] of frames) expectBackground(corner);
  await page.keyboard.press('Escape');
  await expect(dialog()).toHaveCount(0);
  expect([await dataOf(page, 'restarts'), await dataOf(page, 'samples')]).toEqual([restarts, samples]);
});

test('an animation as MP4: the squares change places', async () => {
  await openDialog();
  await dialog().getByLabel('Animation', { exact: true }).selectOption({ label: 'swap' });
  const { name, bytes } = await record({ motion: 'Animation', format: 'MP4', seconds: 0.2, fps: 20 });
  expect(name).toBe('quads.mp4');
  expect(mp4(bytes)).toEqual({ frames: 4, width: 64, height: 48 });
  const { frames } = await played(
    bytes,
    'video/mp4',
    [0.01, 0.19],
    [
      [0.25, 0.5],
      [0.75, 0.5],
    ],
  );
  const red = ([r = 0, g = 0]: readonly number[] = []) => r - g;
  const [first, last] = frames as [number[][], number[][]];
  // Red at the left, then at the right.
  expect(red(first[0])).toBeGreaterThan(red(first[1]) + 40);
  expect(red(last[1])).toBeGreaterThan(red(last[0]) + 40);
  await page.keyboard.press('Escape');
});

test('a camera walk goes through the views that were added; they are steps of undo', async () => {
  await tab(page, 'Camera');
  const note = page.locator('#walk-note');
  await page.getByRole('button', { name: 'Add this view' }).click();
  await expect(note).toContainText('a camera walk needs two');
  await page.getByRole('button', { name: 'Top', exact: true }).click();
  await page.getByRole('button', { name: 'Add this view' }).click();
  await expect(note).toHaveText('2 views.');
  await openDialog();
  await dialog().getByLabel('Motion', { exact: true }).selectOption('walk');
  const { bytes } = await record({ format: 'WebM', seconds: 0.25, fps: 8 });
  expect(webm(bytes)).toEqual({ frames: 2, width: 64, height: 48 });
  await page.keyboard.press('Escape');
  await page.getByRole('button', { name: 'Undo: Add view' }).click();
  await expect(note).toContainText('1 view;');
  await page.getByRole('button', { name: 'Undo: Add view' }).click();
  await page.locator('#home').click();
});

test('a recording is cancelled without a file; where nothing encodes, the dialog says so', async () => {
  let files = 0;
  const count = () => void files++;
  page.on('download', count);
  await openDialog();
  await fill({ motion: 'Turntable', format: 'WebM', seconds: 60, fps: 30 });
  await page.keyboard.press('Enter');
  await expect(dialog().getByRole('progressbar', { name: 'Recorded' })).toBeVisible();
  await expect(page.locator('#video-figures')).toContainText(/of 1800 frames/);
  // The focus is on it.
  await page.keyboard.press('Enter');
  await expect(dialog().getByRole('status')).toHaveText('Cancelled.');

  await page.evaluate(() => Reflect.deleteProperty(window, 'VideoEncoder'));
  await page.getByRole('button', { name: 'Record', exact: true }).click();
  await expect(errorWith(page, 'viewer/video')).toContainText('This browser cannot encode video');
  await page.keyboard.press('Escape');
  page.off('download', count);
  expect(files).toBe(0);
});

import { photograph, quads } from '@glanz/browser';
import { expect, type Page } from '@playwright/test';
import type { Viewer, ViewerOptions } from '@glanz/viewer';

declare global {
  interface Window {
    make: (options?: ViewerOptions) => Viewer;
    file: (base64: string, name: string) => File;
    viewer: Viewer;
    retries: (() => void)[];
    order: string[];
    kernels: string[];
    heard: { type: string; [key: string]: unknown }[];
  }
}

// A red square on the left, a green one on the right that is blue at night; under a constant white sky.
export const model = quads([
  { name: 'left', colour: [0.9, 0.02, 0.02], at: [-1.2, 0, 0] },
  { name: 'right', colour: [0.02, 0.8, 0.02], at: [1.2, 0, 0], variants: { night: [0.02, 0.02, 0.9] } },
]);
export const sky = { type: 'constant', radiance: [1, 1, 1] } as const;
export const front: ViewerOptions['camera'] = {
  type: 'perspective',
  name: 'front',
  transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1],
  yfov: 0.6,
  aspect: 1.6,
};

/** A viewer of the model in its first view, done unless that takes too many samples. */
export async function open(page: Page, origin: string, options: ViewerOptions = {}, bytes = model): Promise<void> {
  await page.goto(origin);
  await page.evaluate(
    async ([base64, given]) => {
      const viewer = (window.viewer = window.make(given as ViewerOptions));
      window.heard = [];
      for (const type of [
        'load',
        'progress',
        'error',
        'warning',
        'sample',
        'converged',
        'camera-change',
        'device-lost',
        'device-restored',
        'state',
        'frame',
        'pick',
      ] as const)
        viewer.on(type, (detail) => void window.heard.push({ ...structuredCloneable(detail), type }));
      await viewer.load(window.file(base64 as string, 'model.glb'));
      function structuredCloneable(detail: object) {
        return Object.fromEntries(
          Object.entries(detail).filter(([, value]) => typeof value !== 'function' && typeof value !== 'object'),
        );
      }
    },
    [
      bytes.toString('base64'),
      { samples: 6, maxDepth: 3, pixelRatio: 0.25, camera: front, environment: sky, ...options },
    ] as const,
  );
  if (options.samples === undefined || options.samples < 100) await done(page);
}

/** Waits until the image is done as it is now: the state is still that of the former one right after a change. */
export async function done(page: Page): Promise<void> {
  // In the page itself: polls of Playwright come up to a second late, in which a core is idle.
  await page.evaluate(async () => {
    const end = performance.now() + 55_000;
    while ((window.viewer.state !== 'done' || window.viewer.sampleCount === 0) && performance.now() < end)
      await new Promise((resolve) => setTimeout(resolve, 30));
  });
  const state = () => page.evaluate(() => [window.viewer.state, window.viewer.sampleCount > 0]);
  await expect.poll(state, { message: 'the image is done' }).toEqual(['done', true]);
}
export const canvas = (page: Page) => page.locator('canvas');
export const heard = (page: Page, type: string) =>
  page.evaluate((expected) => window.heard.filter((event) => event.type === expected), type);
/** Waits until the screen shows what was to be drawn with its next frame. */
export const settled = (page: Page) =>
  page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
export const shot = async (page: Page) => {
  await settled(page);
  // The ring around a canvas that has the keyboard is no part of the image.
  return photograph(canvas(page), 'canvas { outline: none }');
};

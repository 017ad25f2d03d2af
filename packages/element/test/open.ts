import { fileURLToPath } from 'node:url';
import { pixelsOf, quads, servePage, type Served } from '@glanz/browser';
import { expect, type Page } from '@playwright/test';
import type { GlanzViewerElement } from '@glanz/element';

// What the specs of the element share: its page, its model, and how they wait for an image and look at it.

export interface TestWindow {
  put: (attributes: Record<string, string>, children?: string) => GlanzViewerElement;
  file: (base64: string, name: string) => File;
  heard: { type: string; detail: Record<string, unknown>; samples?: number }[];
  loseGpu: () => void;
}
declare const window: TestWindow & typeof globalThis;

// The strictest policy that lets a page use WebGPU at all: nothing inline, no blobs, nothing from elsewhere.
const POLICY =
  "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; worker-src 'self'";
/** The page, under the policy. */
export const serveStrictly = (): Promise<Served> =>
  servePage(fileURLToPath(new URL('page', import.meta.url)), { 'Content-Security-Policy': POLICY });

export const model = quads([
  { name: 'left', colour: [0.9, 0.02, 0.02], at: [-1.2, 0, 0] },
  { name: 'right', colour: [0.02, 0.8, 0.02], at: [1.2, 0, 0], variants: { night: [0.02, 0.02, 0.9] } },
]);

export const FAST = {
  samples: '8',
  'max-depth': '3',
  'pixel-ratio': '0.25',
  'camera-orbit': '0deg 90deg 5m',
  'field-of-view': '35deg',
};
export const viewer = (page: Page) => page.locator('glanz-viewer');
export const heard = (page: Page, type: string) =>
  page.evaluate(
    (expected) => window.heard.filter((event) => event.type === expected).map(({ detail }) => detail),
    type,
  );
export const put = (page: Page, attributes: Record<string, string>, children = '') =>
  page.evaluate(([given, inner]) => void window.put(given as Record<string, string>, inner as string), [
    attributes,
    children,
  ] as const);

/** Waits until the image is done as it is now: the state is still that of the former one right after a change. */
export async function done(page: Page): Promise<void> {
  // In the page itself: polls of Playwright come up to a second late, in which a core is idle.
  await page.evaluate(async () => {
    const isDone = () => {
      const { viewer } = document.querySelector('glanz-viewer') ?? {};
      return viewer?.state === 'done' && viewer.sampleCount > 0;
    };
    const end = performance.now() + 55_000;
    while (!isDone() && performance.now() < end) await new Promise((resolve) => setTimeout(resolve, 30));
  });
  const image = () =>
    page.evaluate(() => {
      const { viewer } = document.querySelector('glanz-viewer') ?? {};
      return [viewer?.state, (viewer?.sampleCount ?? 0) > 0];
    });
  await expect.poll(image, { message: 'the image is done' }).toEqual(['done', true]);
}
export const shot = async (page: Page) => {
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  // Without the progress bar, which fades for half a second.
  return pixelsOf(page, await viewer(page).screenshot({ animations: 'disabled' }));
};

export async function open(
  page: Page,
  origin: string,
  attributes: Record<string, string> = {},
  children = '',
): Promise<void> {
  await page.goto(origin);
  await put(page, { src: 'model.glb', alt: 'Two cards', ...FAST, ...attributes }, children);
  await done(page);
}

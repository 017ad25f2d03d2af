import { fileURLToPath } from 'node:url';
import { animatedQuads, photograph, quads, servePage, watch, type Served } from '@glanz/browser';
import { test } from '@glanz/browser/shared-device';
import { expect, type Page } from '@playwright/test';
import { done, type TestWindow } from './open';

declare const window: TestWindow & typeof globalThis;

let served: Served;
test.beforeAll(async ({ deviceHost }) => {
  served = await servePage(fileURLToPath(new URL('page', import.meta.url)));
  deviceHost.origin = served.origin;
});
test.afterAll(() => served.close());
test.use({ viewport: { width: 640, height: 480 } });

let complaints: string[] = [];
test.beforeEach(async ({ page }) => {
  complaints = watch(page, served.origin);
  await page.route('**/*.glb', (route) =>
    route.fulfill({ body: route.request().url().includes('still') ? still : animatedQuads }),
  );
});
test.afterEach(() => expect(complaints).toEqual([]));

const still = quads([{ name: 'board', colour: [0.9, 0.02, 0.02] }]);
const FAST = {
  samples: '8',
  'max-depth': '3',
  'pixel-ratio': '0.4',
  'camera-orbit': '0deg 90deg 5m',
  'field-of-view': '35deg',
};

async function open(page: Page, attributes: Record<string, string>): Promise<void> {
  await page.goto(served.origin);
  await page.evaluate((given) => void window.put(given), { src: 'model.glb', alt: 'Cards', ...FAST, ...attributes });
  await expect.poll(() => events(page, 'load')).toHaveLength(1);
}
const events = (page: Page, ...types: string[]) =>
  page.evaluate((all) => window.heard.filter(({ type }) => all.includes(type)).map(({ type }) => type), types);
/** What is seen left and right of the middle. */
async function sides(page: Page): Promise<string[]> {
  await done(page);
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  const { cells } = await photograph(page.locator('glanz-viewer'));
  return [cells[3]!, cells[5]!].map(([red, green]) =>
    red! > 2 * green! ? 'red' : green! > 1.8 * red! && green! > 90 ? 'green' : 'page',
  );
}

test('autoplay plays, animation-name poses, and script pauses, seeks and plays again', async ({ page }) => {
  await open(page, { autoplay: '' });
  await expect.poll(() => events(page, 'loop')).not.toEqual([]);
  const state = () =>
    page.evaluate(() => {
      const { paused, duration, currentTime, availableAnimations } = document.querySelector('glanz-viewer')!;
      return {
        paused,
        duration: Math.round(duration * 1e6) / 1e6,
        inside: currentTime >= 0 && currentTime <= duration,
        availableAnimations,
      };
    });
  expect(await state()).toEqual({
    paused: false,
    duration: 0.2,
    inside: true,
    availableAnimations: ['swap', 'away'],
  });
  await page.evaluate(() => {
    const element = document.querySelector('glanz-viewer')!;
    element.pause();
    element.currentTime = 0.2;
  });
  expect((await state()).paused).toBe(true);
  await expect.poll(() => sides(page)).toEqual(['green', 'red']);

  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.animationName = 'away'));
  await expect.poll(() => sides(page)).toEqual(['red', 'green']);
  await page.evaluate(() => {
    const element = document.querySelector('glanz-viewer')!;
    element.timeScale = 4;
    element.play({ repetitions: 1 });
  });
  await expect.poll(() => events(page, 'finished')).toEqual(['finished']);
  await expect.poll(() => sides(page)).toEqual(['page', 'green']);
  expect(await events(page, 'play', 'pause', 'finished')).toEqual(['play', 'pause', 'play', 'finished']);

  // One that it has not is reported, and the model stays.
  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.animationName = 'dance'));
  await expect
    .poll(() => page.evaluate(() => window.heard.find(({ type }) => type === 'error')?.detail))
    .toMatchObject({
      code: 'viewer/animation',
    });
});

test.describe('for who wants less motion', () => {
  test.use({ contextOptions: { reducedMotion: 'reduce' } });
  test('autoplay does not play; the page still can', async ({ page }) => {
    await open(page, { autoplay: '' });
    expect(await page.evaluate(() => document.querySelector('glanz-viewer')!.paused)).toBe(true);
    await done(page);
    expect(await events(page, 'play')).toEqual([]);
    await page.evaluate(() => document.querySelector('glanz-viewer')!.play({ repetitions: 1 }));
    await expect.poll(() => events(page, 'play', 'finished')).toEqual(['play', 'finished']);
  });
});

test('orientation, scale and a ground follow their attributes; the ground is not framed', async ({ page }) => {
  await open(page, { src: 'still.glb', orientation: '0deg 0deg 90deg', scale: '2 1 1', 'shadow-intensity': '0.8' });
  const look = () =>
    page.evaluate(() => {
      const element = document.querySelector('glanz-viewer')!;
      const [board, ground] = element.viewer!.scene!.instances;
      const [x, y, z] = element.getCameraOrbit()!.target;
      return {
        x: Array.from(board!.transform).slice(0, 3).map(Math.round),
        ground: ground && Math.round(100 * ground.transform[13]!) / 100,
        target: [x, y, z].map((value) => Math.round(10 * value) / 10 + 0),
      };
    });
  // The board's own x axis, twice as long, points backwards.
  expect(await look()).toEqual({ x: [0, 0, -2], ground: -1, target: [0, 0, 0] });
  await page.evaluate(() => {
    const element = document.querySelector('glanz-viewer')!;
    element.orientation = null;
    element.scale = '3';
  });
  await expect.poll(look).toEqual({ x: [3, 0, 0], ground: -3, target: [0, 0, 0] });
  await page.evaluate(() => document.querySelector('glanz-viewer')!.setAttribute('scale', '0'));
  await expect
    .poll(() => page.evaluate(() => window.heard.find(({ type }) => type === 'error')?.detail))
    .toMatchObject({
      code: 'element/attribute',
    });
  expect(await page.evaluate(() => document.querySelector('glanz-viewer')!.viewer!.modelTransform)).toBeUndefined();
});

test('sensitivities scale the controls, the prompt shows once and goes at the first input, and events tell of the view', async ({
  page,
}) => {
  await open(page, {
    src: 'still.glb',
    'camera-controls': '',
    'orbit-sensitivity': '3',
    'interpolation-decay': '0',
    'interaction-prompt': 'auto',
    'interaction-prompt-threshold': '50',
  });
  const prompt = page.locator('glanz-viewer').locator('.prompt');
  await expect(prompt).toBeVisible();
  await expect(prompt).toHaveAttribute('aria-hidden', 'true');
  await done(page);
  expect(await events(page, 'preload', 'load', 'environment-change', 'model-visibility')).toEqual([
    'preload',
    'load',
    'environment-change',
    'model-visibility',
  ]);
  // A key turns by 7.5 degrees.
  await page.keyboard.press('Tab');
  await page.keyboard.press('ArrowRight');
  await expect(prompt).toHaveCount(0);
  const theta = await page.evaluate(() => document.querySelector('glanz-viewer')!.getCameraOrbit()!.theta);
  expect(theta).toBeCloseTo((3 * Math.PI) / 24, 6);
  await done(page);
  const scales = () =>
    page.evaluate(() =>
      window.heard.filter(({ type }) => type === 'render-scale').map(({ detail }) => detail['renderedDpr'] as number),
    );
  // The image is drawn with the next frame of the screen.
  await expect.poll(async () => (await scales()).at(-1)).toBeCloseTo(0.4, 6);
  expect(Math.min(...(await scales()))).toBeLessThan(0.4);
  await page.evaluate(() => document.querySelector('glanz-viewer')!.showPoster());
  expect(await page.evaluate(() => window.heard.findLast(({ type }) => type === 'model-visibility')!.detail)).toEqual({
    visible: false,
  });
});

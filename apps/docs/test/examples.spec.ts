import { fileURLToPath } from 'node:url';
import { photograph, quads, servePage, watch, type Served } from '@glanz/browser';
import { test } from '@glanz/browser/shared-device';
import { expect, type Page } from '@playwright/test';
import type { GlanzViewerElement } from '@glanz/element';
import type { Viewer } from '@glanz/viewer';
import type * as compatExample from '../examples/three-compat';
import type * as liveExample from '../examples/three-live';
import type * as threeExample from '../examples/three-scene';
import type * as viewerExample from '../examples/viewer';

interface TestWindow {
  examples: typeof viewerExample & {
    three: typeof threeExample;
    live: typeof liveExample;
    compat: typeof compatExample;
  };
  putElement: () => GlanzViewerElement;
  viewer: Viewer;
}
declare const window: TestWindow & typeof globalThis;

// Examples that want a page; those that do not run in examples.test.ts.

let served: Served;
test.beforeAll(async ({ deviceHost }) => {
  served = await servePage(fileURLToPath(new URL('examples-page', import.meta.url)));
  deviceHost.origin = served.origin;
});
test.afterAll(() => served.close());
test.use({ viewport: { width: 640, height: 640 } });

let complaints: string[] = [];
test.beforeEach(async ({ page }) => {
  complaints = watch(page, served.origin);
  await page.route('**/model.glb', (route) => route.fulfill({ body: model }));
  await page.goto(served.origin);
});
test.afterEach(() => expect(complaints).toEqual([]));

const model = quads([
  { name: 'left', colour: [0.9, 0.02, 0.02], at: [-1.2, 0, 0] },
  { name: 'right', colour: [0.02, 0.8, 0.02], at: [1.2, 0, 0], variants: { night: [0.02, 0.02, 0.9] } },
]);

/** A viewer as the example starts it, made quick. */
async function started(page: Page): Promise<void> {
  await page.evaluate(async () => {
    window.viewer = await window.examples.start(document.querySelector('canvas')!, 'model.glb');
    Object.assign(window.viewer, { samples: 6, maxDepth: 3, pixelRatio: 0.25 });
  });
}

const done = (page: Page) => expect.poll(() => page.evaluate(() => window.viewer.state)).toBe('done');

test('the viewer: it starts, emits events, is edited, looked at, pinned to, dropped on and saved', async ({ page }) => {
  await started(page);
  await page.evaluate(() =>
    window.examples.showEvents(window.viewer, document.querySelector('progress')!, document.querySelector('#line')!),
  );
  await page.evaluate(() => window.examples.pin(window.viewer, document.querySelector('#pin')!, [-1.2, 0, 0]));
  await page.evaluate(() => window.examples.acceptDrops(window.viewer));
  await page.evaluate(() => void (window.viewer.samples = 7));
  await done(page);
  await expect(page.locator('#line')).toHaveText(/^Done in /);
  await expect(page.locator('#pin')).toHaveAttribute('style', /translate: \d/);
  const before = await photograph(page.locator('canvas'));
  await page.evaluate(() => window.examples.dress(window.viewer));
  // The one on the right is gone, the one on the left yellow: seen with the next frame.
  await expect
    .poll(async () => Math.abs((await photograph(page.locator('canvas'))).mean[1] - before.mean[1]))
    .toBeGreaterThan(0.5);
  await done(page);
  expect(await page.evaluate(() => window.viewer.scene!.instances.map(({ visible }) => visible))).toEqual([
    undefined,
    false,
  ]);
  expect(await page.evaluate(async () => (await window.examples.save(window.viewer)).type)).toBe('image/png');
  const rendered = await page.evaluate(async () => {
    const bar = document.createElement('progress');
    const blob = await window.examples.render(window.viewer, bar, new AbortController().signal, [8, 6]);
    const { width, height } = await createImageBitmap(blob);
    return [width, height, bar.value];
  });
  expect(rendered).toEqual([8, 6, 1]);
  // It turns by itself a while later.
  const theta = await page.evaluate(() => {
    window.examples.look(window.viewer);
    return window.viewer.orbit!.theta;
  });
  expect(theta).toBeCloseTo(Math.PI / 4, 6);
  await expect.poll(() => page.evaluate(() => window.viewer.state)).not.toBe('done');
  await page.evaluate(() => void (window.viewer.autoRotate = 0));
  // At rest, or the line of the next sample replaces the message.
  await done(page);

  const transfer = await page.evaluateHandle(() => {
    const made = new DataTransfer();
    made.items.add(new File(['nothing'], 'bad.glb'));
    return made;
  });
  await page.dispatchEvent('canvas', 'drop', { dataTransfer: transfer });
  await expect(page.locator('#line')).toHaveText(/glTF/);
});

test('a scene of three.js', async ({ page }) => {
  await started(page);
  expect(await page.evaluate(() => window.examples.three.show(window.viewer))).toEqual([]);
  await done(page);
  // Red, in the middle, under a light that is brighter above than below.
  const { cells, deviation } = await photograph(page.locator('canvas'));
  expect(deviation).toBeGreaterThan(15);
  expect(cells[4]![0]).toBeGreaterThan(1.3 * cells[4]![1]);
});

test("a live scene of three.js, and three-gpu-pathtracer's interface", async ({ page }) => {
  await page.evaluate(async () => {
    const canvases = ['live', 'compat'].map((id) => {
      const canvas = Object.assign(document.createElement('canvas'), { id, width: 48, height: 32 });
      document.body.append(canvas);
      return canvas;
    });
    const control = new AbortController();
    const { tracer } = await window.examples.live.follow(canvases[0]!, control.signal);
    const pathTracer = window.examples.compat.start(canvases[1]!);
    Object.assign(window, { tracer, pathTracer, control });
  });
  const samples = () =>
    page.evaluate(() => {
      const { tracer, pathTracer } = window as unknown as Record<string, { samples: number }>;
      return Math.min(tracer!.samples, pathTracer!.samples);
    });
  await expect.poll(samples).toBeGreaterThan(1);
  for (const id of ['live', 'compat'])
    await expect.poll(async () => (await photograph(page.locator(`#${id}`))).deviation, id).toBeGreaterThan(10);
  await page.evaluate(() => (window as unknown as { control: AbortController }).control.abort());
});

test('the element of the guide', async ({ page }) => {
  await page.evaluate(() => void Object.assign(window.putElement(), { samples: 4, maxDepth: 3, pixelRatio: 0.25 }));
  await expect
    .poll(() => page.evaluate(() => document.querySelector('glanz-viewer')!.viewer?.state), { timeout: 60_000 })
    .toBe('done');
  await expect(page.getByRole('button', { name: 'The left one' })).toBeVisible();
  await expect(page.getByText('Loading …')).toBeHidden();
  expect(await page.evaluate(() => document.querySelector('glanz-viewer')!.getCameraOrbit()!.theta)).toBeCloseTo(
    Math.PI / 9,
    3,
  );
});

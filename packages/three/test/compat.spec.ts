import { fileURLToPath } from 'node:url';
import { injectFaults, photograph, servePage, watch, type Served } from '@glanz/browser';
import { test } from '@glanz/browser/shared-device';
import { expect } from '@playwright/test';
import type { WebGLPathTracer, WebGPUPathTracer } from '@glanz/three/compat';
import type { PerspectiveCamera, Scene } from 'three';

interface TestWindow {
  start: (name: string) => boolean;
  state: () => { samples: number; film: number; isCompiling: boolean; error?: string };
  running: () => { pathTracer: WebGLPathTracer; scene: Scene; camera: PerspectiveCamera };
  loseGpu: () => void;
  startWebGpu: () => Promise<number>;
  pathTracer: WebGPUPathTracer;
  drawn: { readonly rasterised: number; readonly pathTraced: number };
  pause: (pause: boolean) => void;
  compare: () => Promise<{ worst: number; mean: number; width: number; height: number }>;
}
declare const window: TestWindow & typeof globalThis;

let served: Served;
test.beforeAll(async ({ deviceHost }) => {
  served = await servePage(fileURLToPath(new URL('compat-page', import.meta.url)));
  deviceHost.origin = served.origin;
});
test.afterAll(() => served.close());
test.use({ viewport: { width: 320, height: 240 } });

const isFull = process.env['GLANZ_FULL'] !== undefined;
for (const name of ['materialBalls', ...(isFull ? ['interior', 'glass'] : []), 'depthOfField']) {
  test(`${name}: the scene with one import changed is rasterised, then shows the film of fromThree and PathTracer`, async ({
    page,
  }, info) => {
    const complaints = watch(page, served.origin);
    await page.goto(served.origin);
    expect(await page.evaluate((scene) => window.start(scene), name)).toBe(true);
    const canvas = page.locator('canvas');
    await expect.poll(async () => (await photograph(canvas)).deviation).toBeGreaterThan(5);
    await info.attach('rasterised', { body: await canvas.screenshot(), contentType: 'image/png' });
    await expect.poll(() => page.evaluate(() => window.state().samples)).toBeGreaterThanOrEqual(2);
    expect(await page.evaluate(() => window.state())).toMatchObject({ isCompiling: false, error: undefined });
    await page.evaluate(() => window.pause(true));
    await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
    await info.attach('path-traced', { body: await canvas.screenshot(), contentType: 'image/png' });
    const { worst, mean, width, height } = await page.evaluate(() => window.compare());
    expect([width, height]).toEqual([64, 48]);
    expect(mean).toBeGreaterThan(0.05);
    // Halves have 11 bits.
    expect(worst).toBeLessThan(2 ** -10);
    expect(complaints.filter((complaint) => !complaint.includes('GPU stall'))).toEqual([]);
  });
}

test('a scene that changes, a lost device, pauses, sizes and callbacks', async ({ page }) => {
  await injectFaults(page);
  await page.goto(served.origin);
  await page.evaluate(() => window.start('depthOfField'));
  const samples = () => page.evaluate(() => window.state().samples);
  await expect.poll(samples).toBeGreaterThan(0);

  // The same scene again is an edit, and so is what the update methods are for: the tracer stays.
  await page.evaluate(async () => {
    const { pathTracer, scene, camera } = window.running();
    const before = pathTracer.threePathTracer!.tracer;
    scene.children[2]!.position.y += 0.2;
    await pathTracer.setSceneAsync(scene, camera);
    camera.position.x += 1;
    pathTracer.updateCamera();
    if (pathTracer.samples !== 0 || pathTracer.threePathTracer!.tracer !== before)
      throw new Error('The image did not begin again.');
  });
  await expect.poll(samples).toBeGreaterThan(0);
  const seen = await page.evaluate(() => {
    const { pathTracer, camera } = window.running();
    return [pathTracer.threePathTracer!.tracer.camera.transform[12], camera.position.x];
  });
  expect(seen[0]).toBeCloseTo(seen[1]!, 6);

  // Another device replaces a lost one.
  await page.evaluate(() => {
    (window as { lost?: unknown }).lost = window.running().pathTracer.threePathTracer;
    window.loseGpu();
  });
  await expect
    .poll(() =>
      page.evaluate(() => {
        const { threePathTracer, samples: shown, error } = window.running().pathTracer;
        return threePathTracer !== (window as { lost?: unknown }).lost && shown > 0 && error === undefined;
      }),
    )
    .toBe(true);

  // Callbacks get the target and what draws it.
  await page.evaluate(() => {
    const { pathTracer } = window.running();
    const calls: string[] = [];
    Object.assign(window, { calls });
    pathTracer.renderToCanvasCallback = (target, _, quad) => {
      calls.push('path-traced');
      if (quad.material.map !== target.texture) throw new Error('The quad shows something else.');
    };
    pathTracer.rasterizeSceneCallback = () => void calls.push('rasterised');
  });
  const calls = () => page.evaluate(() => [...new Set((window as unknown as { calls: string[] }).calls.splice(0))]);
  await expect.poll(calls).toEqual(['path-traced']);
  await page.evaluate(() => void (window.running().pathTracer.enablePathTracing = false));
  await expect.poll(calls).toEqual(['rasterised']);
  await page.evaluate(() => void (window.running().pathTracer.enablePathTracing = true));

  // The film follows the renderer, at its scale; a small image comes first.
  await page.evaluate(() => {
    const { pathTracer } = window.running();
    pathTracer.dynamicLowRes = true;
    pathTracer.lowResScale = 0.5;
    pathTracer.renderScale = 0.75;
    pathTracer.pausePathTracing = false;
  });
  await expect
    .poll(() =>
      page.evaluate(() => [window.running().pathTracer.target.width, window.running().pathTracer.target.height]),
    )
    .toEqual([48, 36]);
  await expect.poll(samples).toBeGreaterThan(1);

  // A pause keeps the image.
  await page.evaluate(() => window.pause(true));
  await page.evaluate(async () => {
    const { pathTracer } = window.running();
    await pathTracer.threePathTracer!.sample();
    const frame = () => new Promise(requestAnimationFrame);
    const { samples: film } = pathTracer.threePathTracer!;
    for (let i = 0; i < 5; i++) await frame();
    if (pathTracer.threePathTracer!.samples !== film) throw new Error('Samples were added.');
    pathTracer.dispose();
    await frame();
  });
});

test('by a WebGPU renderer, until there are as many samples as asked for', async ({ page }, info) => {
  const complaints = watch(page, served.origin);
  await page.goto(served.origin);
  await page.evaluate(() => window.startWebGpu());
  const canvas = page.locator('canvas');
  await expect.poll(() => page.evaluate(() => window.pathTracer.samples)).toBe(3);
  await expect.poll(() => page.evaluate(() => window.drawn.pathTraced)).toBeGreaterThan(1);
  expect(await page.evaluate(() => window.drawn.rasterised)).toBeGreaterThan(0);
  await info.attach('path-traced', { body: await canvas.screenshot(), contentType: 'image/png' });
  // Seen head on, the ball's middle has the light of all directions: its albedo, on three's own curve.
  await expect.poll(async () => (await photograph(canvas)).leading.red).toBeGreaterThan(0.2);
  const { cells } = await photograph(canvas);
  expect(cells[4]![0]).toBeGreaterThan(150);
  expect(cells[4]![2]).toBeLessThan(80);
  expect(await page.evaluate(() => window.pathTracer.getSampleCountsAsync())).toMatchObject({ min: 3, max: 3, avg: 3 });
  expect(await page.evaluate(() => window.pathTracer.threePathTracer!.samples)).toBe(3);
  expect(complaints.filter((complaint) => !complaint.includes('GPU stall'))).toEqual([]);
});

import { fileURLToPath } from 'node:url';
import { injectFaults, servePage, watch, type Served } from '@glanz/browser';
import { expect, test } from '@playwright/test';
import { done, heard, model, open, shot } from './open';

let served: Served;
test.beforeAll(async () => void (served = await servePage(fileURLToPath(new URL('page', import.meta.url)))));
test.afterAll(() => served.close());
test.use({ viewport: { width: 640, height: 480 } });

let complaints: string[] = [];
test.beforeEach(({ page }) => void (complaints = watch(page, served.origin)));
test.afterEach(() => expect(complaints).toEqual([]));

const base64 = model.toString('base64');

test('after it gave up, load() and an explicit retry ask for a device again', async ({ page }) => {
  await injectFaults(page);
  await open(page, served.origin);
  const before = await shot(page);
  const giveUp = async (losses: number) => {
    for (let i = 0; i < losses; i++) {
      await expect.poll(() => page.evaluate(() => window.viewer.device !== undefined)).toBe(true);
      await page.evaluate(() => window.loseGpu());
      await expect.poll(() => page.evaluate(() => window.viewer.device === undefined)).toBe(true);
    }
    await expect.poll(() => page.evaluate(() => window.viewer.state)).toBe('failed');
  };
  await giveUp(4);
  const errors = await heard(page, 'error');
  expect(errors.map(({ code }) => code)).toEqual(['viewer/device-lost']);
  const devices = await page.evaluate(() => window.gpuFaults.devices);
  expect(await page.evaluate(async (bytes) => (await window.viewer.load(window.file(bytes, 'model.glb'))).instances.length, base64)).toBe(2);
  expect(await page.evaluate(() => window.gpuFaults.devices)).toBe(devices + 1);
  await done(page);
  expect((await shot(page)).cells).toEqual(before.cells);

  // Former losses are forgiven: it takes four again. Then a load that fails brings back what was there.
  await giveUp(4);
  const code = await page.evaluate(async () => {
    const scene = { ...window.viewer.scene!, materials: [] };
    return window.viewer.load(scene).then(() => 'loaded', (error: { code: string }) => error.code);
  });
  expect(code).toMatch(/^scene\//);
  await done(page);
  expect((await shot(page)).cells).toEqual(before.cells);

  // And the retry of the event, pressed twice.
  await page.evaluate(() => {
    window.retries = [];
    window.viewer.on('error', ({ retry }) => retry && window.retries.push(retry));
  });
  await giveUp(4);
  const asked = await page.evaluate(() => {
    const before = window.gpuFaults.devices;
    window.retries[0]!();
    window.retries[0]!();
    return before;
  });
  await done(page);
  expect(await page.evaluate(() => window.gpuFaults.devices)).toBe(asked + 1);
  expect((await shot(page)).cells).toEqual(before.cells);
});

test('an abort, a newer load and destroy() end a load at once, although the driver goes on compiling', async ({ page }) => {
  await injectFaults(page);
  await open(page, served.origin);
  const before = await shot(page);
  // Another depth of features: kernels that are not there yet.
  const result = await page.evaluate(async (bytes) => {
    const { viewer, gpuFaults: faults } = window;
    const scene = () => ({ ...viewer.scene!, materials: viewer.scene!.materials.map((material) => ({ ...material, parameters: { ...material.parameters, coat_weight: 0.5, fuzz_weight: 0.5 } })) });
    const end = (load: Promise<unknown>) => load.then(() => 'loaded', (error: Error) => error.name);
    const compiling = async () => {
      const from = faults.count['createComputePipelineAsync'] ?? 0;
      while ((faults.count['createComputePipelineAsync'] ?? 0) === from) await new Promise((resolve) => setTimeout(resolve, 5));
    };
    faults.holdPipelines = 'glanz';
    const ends: string[] = [];
    // By a signal.
    const control = new AbortController();
    const one = end(viewer.load(scene(), { signal: control.signal }));
    await compiling();
    control.abort();
    ends.push(await one);
    // By a newer load, of a file that is there already.
    const two = end(viewer.load(scene()));
    await new Promise((resolve) => setTimeout(resolve, 300));
    const three = end(viewer.load(window.file(bytes, 'model.glb')));
    ends.push(await two);
    faults.holdPipelines = undefined;
    ends.push(await three);
    return ends;
  }, base64);
  expect(result).toEqual(['AbortError', 'AbortError', 'loaded']);
  await done(page);
  expect((await shot(page)).cells).toEqual(before.cells);
  expect(await heard(page, 'error')).toEqual([]);
  const left = await page.evaluate(async () => {
    const { viewer, gpuFaults: faults } = window;
    faults.holdPipelines = 'glanz';
    const scene = { ...viewer.scene!, materials: viewer.scene!.materials.map((material) => ({ ...material, parameters: { ...material.parameters, subsurface_weight: 0.5 } })) };
    const load = viewer.load(scene).then(() => 'loaded', (error: Error) => error.name);
    await new Promise((resolve) => setTimeout(resolve, 300));
    viewer.destroy();
    const end = await load;
    faults.holdPipelines = undefined;
    await new Promise((resolve) => setTimeout(resolve, 300));
    return { end, after: faults.live(), errors: faults.errors };
  });
  expect(left).toMatchObject({ end: 'AbortError', after: {}, errors: [] });
});

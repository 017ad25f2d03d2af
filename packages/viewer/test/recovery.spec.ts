import { fileURLToPath } from 'node:url';
import { injectFaults, servePage, watch, type Served } from '@glanz/browser';
import { expect, test, type Page } from '@playwright/test';
import type { PathTracer } from '@glanz/renderer';
import { done, heard, model, open, shot } from './open';

declare global {
  interface Window {
    /** Of {@link watchCopies}. */
    copies: number[];
  }
}

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
      // In the page itself: the next device may be there before a poll.
      await page.evaluate(async () => {
        const { device } = window.viewer;
        window.loseGpu();
        while (window.viewer.device === device) await new Promise((resolve) => setTimeout(resolve, 5));
      });
    }
    await expect.poll(() => page.evaluate(() => window.viewer.state)).toBe('failed');
  };
  await giveUp(4);
  const errors = await heard(page, 'error');
  expect(errors.map(({ code }) => code)).toEqual(['viewer/device-lost']);
  const devices = await page.evaluate(() => window.gpuFaults.devices);
  expect(
    await page.evaluate(
      async (bytes) => (await window.viewer.load(window.file(bytes, 'model.glb'))).instances.length,
      base64,
    ),
  ).toBe(2);
  expect(await page.evaluate(() => window.gpuFaults.devices)).toBe(devices + 1);
  await done(page);
  expect((await shot(page)).cells).toEqual(before.cells);

  // Former losses are forgiven: it takes four again. Then a load that fails brings back what was there.
  await giveUp(4);
  const code = await page.evaluate(async () => {
    const scene = { ...window.viewer.scene!, materials: [] };
    return window.viewer.load(scene).then(
      () => 'loaded',
      (error: { code: string }) => error.code,
    );
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

test('a GPU that is lost again while the scene is rebuilt: one report at the end, of success or of failure', async ({
  page,
}) => {
  await injectFaults(page);
  await open(page, served.origin);
  const before = await shot(page);
  // Each loss comes while the kernels for the device before are compiled.
  const loseTwice = async () => {
    await page.evaluate(() => (window.gpuFaults.holdPipelines = 'glanz generate'));
    const compiled = () => page.evaluate(() => window.gpuFaults.count['createComputePipelineAsync'] ?? 0);
    const former = await compiled();
    await page.evaluate(() => window.loseGpu());
    await expect.poll(compiled).toBeGreaterThan(former);
    await page.evaluate(() => window.loseGpu());
  };
  const release = () => page.evaluate(() => (window.gpuFaults.holdPipelines = undefined));

  await loseTwice();
  await release();
  await done(page);
  expect(await heard(page, 'device-lost')).toHaveLength(2);
  expect(await heard(page, 'device-restored')).toHaveLength(1);
  expect(await heard(page, 'error')).toEqual([]);
  expect((await shot(page)).cells).toEqual(before.cells);

  await loseTwice();
  await expect.poll(() => page.evaluate(() => window.viewer.state)).toBe('failed');
  await release();
  await page.waitForTimeout(500);
  expect((await heard(page, 'error')).map(({ code }) => code)).toEqual(['viewer/device-lost']);
  expect(await heard(page, 'device-restored')).toHaveLength(1);
});

test('an abort, a newer load and destroy() end a load at once, although the driver still compiles', async ({
  page,
}) => {
  await injectFaults(page);
  await open(page, served.origin);
  const before = await shot(page);
  // Another depth of features: kernels that do not exist yet.
  const result = await page.evaluate(async (bytes) => {
    const { viewer, gpuFaults: faults } = window;
    const scene = () => ({
      ...viewer.scene!,
      materials: viewer.scene!.materials.map((material) => ({
        ...material,
        parameters: { ...material.parameters, coat_weight: 0.5, fuzz_weight: 0.5 },
      })),
    });
    const end = (load: Promise<unknown>) =>
      load.then(
        () => 'loaded',
        (error: Error) => error.name,
      );
    const compiling = async () => {
      const from = faults.count['createComputePipelineAsync'] ?? 0;
      while ((faults.count['createComputePipelineAsync'] ?? 0) === from)
        await new Promise((resolve) => setTimeout(resolve, 5));
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
    const scene = {
      ...viewer.scene!,
      materials: viewer.scene!.materials.map((material) => ({
        ...material,
        parameters: { ...material.parameters, subsurface_weight: 0.5 },
      })),
    };
    const load = viewer.load(scene).then(
      () => 'loaded',
      (error: Error) => error.name,
    );
    await new Promise((resolve) => setTimeout(resolve, 300));
    viewer.destroy();
    const end = await load;
    faults.holdPipelines = undefined;
    await new Promise((resolve) => setTimeout(resolve, 300));
    return { end, after: faults.live(), errors: faults.errors };
  });
  expect(left).toMatchObject({ end: 'AbortError', after: {}, errors: [] });
});

/** Notes how many samples each copy has that is made of a film from now on. */
const watchCopies = (page: Page) =>
  page.evaluate(() => {
    const tracers = Object.getPrototypeOf(window.viewer.tracer) as PathTracer;
    const { saveFilm } = tracers;
    window.copies = [];
    tracers.saveFilm = async function (...given) {
      const state = await saveFilm.apply(this, given);
      window.copies.push(state.samples);
      return state;
    };
  });
const copies = (page: Page) => page.evaluate(() => window.copies);
const film = (page: Page) => page.evaluate(async () => Array.from(await window.viewer.tracer!.read('beauty')).join());
const lose = async (page: Page) => {
  const before = (await heard(page, 'device-restored')).length;
  await page.evaluate(() => {
    window.heard = window.heard.filter(({ type }) => type !== 'sample');
    window.loseGpu();
  });
  await expect.poll(async () => (await heard(page, 'device-restored')).length).toBe(before + 1);
  return (await heard(page, 'device-restored')).at(-1)!;
};

test('samples outlive a lost GPU: a finished image is the same to the last bit and is not rendered again', async ({
  page,
}) => {
  await injectFaults(page);
  await open(page, served.origin);
  await watchCopies(page);
  await page.evaluate(() => window.viewer.setMaterial('left', { base_color: [0.9, 0.9, 0.02] }));
  await done(page);
  await expect.poll(async () => (await copies(page)).at(-1)).toBe(6);
  const before = await film(page);
  for (const _ of [1, 2]) {
    expect(await lose(page)).toMatchObject({ samples: 6, lostSamples: 0 });
    await done(page);
    expect(await film(page)).toBe(before);
    expect(await heard(page, 'sample')).toEqual([]);
  }
  expect(await page.evaluate(() => window.viewer.sampleCount)).toBe(6);
  // More of them continue from there: the same as without a loss.
  await page.evaluate(() => void (window.viewer.samples = 10));
  await expect.poll(async () => (await heard(page, 'sample')).at(-1)?.['samples']).toBe(10);
  await done(page);
  expect((await heard(page, 'sample')).every((event) => (event['samples'] as number) > 6)).toBe(true);
  const resumed = await film(page);
  await page.evaluate(() => window.viewer.tracer!.reset());
  await page.evaluate(() => window.viewer.edit(() => undefined));
  await done(page);
  expect(await film(page)).toBe(resumed);
});

test('an image that is being rendered continues from its last copy; without a copy the event says what was lost', async ({
  page,
}) => {
  await injectFaults(page);
  await open(page, served.origin, { samples: 1_000_000 });
  const samples = async () => ((await heard(page, 'sample')).at(-1)?.['samples'] as number | undefined) ?? 0;
  // The first copy is made after three seconds.
  await watchCopies(page);
  await expect.poll(() => copies(page)).not.toEqual([]);
  const restored = await lose(page);
  const kept = restored['samples'] as number;
  expect(kept).toBeGreaterThan(0);
  expect(restored['lostSamples']).toBeGreaterThanOrEqual(0);
  await expect.poll(samples).toBeGreaterThan(kept);
  expect((await heard(page, 'sample'))[0]!['samples']).toBeGreaterThan(kept);

  // A view that has moved meanwhile is another image.
  await page.evaluate(() => {
    window.viewer.on('device-lost', () => window.viewer.setOrbit({ theta: 0.5 }, { immediate: true }), { once: true });
  });
  const moved = await lose(page);
  expect(moved['samples']).toBe(0);
  expect(moved['lostSamples']).toBeGreaterThanOrEqual(kept);
  await expect.poll(samples).toBeGreaterThan(0);
  expect(await page.evaluate(() => window.viewer.camera!.transform[12])).not.toBe(0);

  await page.evaluate(() => window.viewer.destroy());
  await open(page, served.origin, { keepSamples: false });
  expect(await lose(page)).toMatchObject({ samples: 0, lostSamples: 6 });
  await done(page);
  expect(await heard(page, 'error')).toEqual([]);
});

test('without memory for a larger film the image stays as large as it can, with one error, and the viewer keeps working', async ({
  page,
}) => {
  await injectFaults(page);
  await open(page, served.origin);
  // Films of up to a third of the new size's.
  await page.evaluate(() => {
    window.gpuFaults.memory = window.gpuFaults.bytes() + 375_000;
    Object.assign(document.querySelector('canvas')!.style, { width: '640px', height: '400px' });
  });
  await expect.poll(async () => (await heard(page, 'error')).length).toBe(1);
  await done(page);
  const errors = await heard(page, 'error');
  expect(errors.map(({ code }) => code)).toEqual(['renderer/out-of-memory']);
  const size = await page.evaluate(() => [
    window.viewer.tracer!.width,
    window.viewer.tracer!.height,
    window.viewer.sampleCount,
  ]);
  expect(size[0]).toBeLessThan(160);
  expect(size[2]).toBe(6);
  expect(size[0]! / size[1]!).toBeCloseTo(1.6, 1);
  const { cells } = await shot(page);
  expect(cells[3]![0]).toBeGreaterThan(2 * cells[3]![1]);
  // Edits and movements work, and with memory the next size is the whole one again.
  await page.evaluate(() => window.viewer.setOrbit({ theta: 0.3 }, { immediate: true }));
  await done(page);
  await page.evaluate(() => {
    window.gpuFaults.memory = undefined;
    document.querySelector('canvas')!.style.width = '600px';
  });
  await expect.poll(() => page.evaluate(() => window.viewer.tracer!.width)).toBe(150);
  await done(page);
  expect(await heard(page, 'error')).toHaveLength(1);
});

test('a film that had to be smaller takes the whole size, and its shape, once there is memory', async ({ page }) => {
  await injectFaults(page);
  await open(page, served.origin);
  await page.evaluate(() => {
    window.gpuFaults.memory = window.gpuFaults.bytes() + 150_000;
    Object.assign(document.querySelector('canvas')!.style, { width: '440px', height: '440px' });
  });
  await expect
    .poll(async () => (await heard(page, 'error')).map(({ code }) => code))
    .toEqual(['renderer/out-of-memory']);
  await done(page);
  const [width, height] = await page.evaluate(() => [window.viewer.tracer!.width, window.viewer.tracer!.height]);
  expect(width).toBeLessThan(110);
  expect(height).toBe(width);
  // There is no input to the page.
  await page.evaluate(() => void (window.gpuFaults.memory = undefined));
  await expect
    .poll(() => page.evaluate(() => [window.viewer.tracer!.width, window.viewer.tracer!.height]))
    .toEqual([110, 110]);
  await done(page);
  expect(await page.evaluate(() => window.viewer.sampleCount)).toBe(6);
  const { cells } = await shot(page);
  expect(cells[3]![0]).toBeGreaterThan(2 * cells[3]![1]);
  expect(await heard(page, 'error')).toHaveLength(1);
});

import { fileURLToPath } from 'node:url';
import { injectFaults, servePage, watch, type Served } from '@glanz/browser';
import { test } from '@glanz/browser/shared-device';
import { expect } from '@playwright/test';
import { done, heard, model, open, shot } from './open';

declare global {
  interface Window {
    gate?: Promise<void>;
    openGate: () => void;
  }
}

let served: Served;
test.beforeAll(async ({ deviceHost }) => {
  served = await servePage(fileURLToPath(new URL('page', import.meta.url)));
  deviceHost.origin = served.origin;
});
test.afterAll(() => served.close());
test.use({ viewport: { width: 640, height: 480 } });

let complaints: string[] = [];
test.beforeEach(({ page }) => void (complaints = watch(page, served.origin)));
test.afterEach(() => expect(complaints).toEqual([]));

const base64 = model.toString('base64');

test('an edit or an environment that is refused, or has no memory, leaves the scene as it was, and others work', async ({
  page,
}) => {
  await injectFaults(page);
  await open(page, served.origin);
  const before = await shot(page);
  const ends = await page.evaluate(async () => {
    const { viewer, gpuFaults: faults } = window;
    const end = (work: Promise<unknown>) =>
      work.then(
        () => 'done',
        (error: { code?: string }) => error.code ?? String(error),
      );
    const ends: string[] = [];
    // Of two edits of one material in one frame, one is refused.
    ends.push(
      ...(await Promise.all(
        [
          viewer.setMaterial('left', { base_color: [0.9, 0.9, 0.02] }),
          viewer.setMaterial('left', { base_metalness: NaN }),
        ].map(end),
      )),
    );
    ends.push(await end(viewer.setMaterial('left', { no_such: 1 } as never)));
    ends.push(await end(viewer.setMaterial('left', { base_color: [0.9, 0.02, 0.02] })));
    // An image as an environment needs textures and tables of its own.
    const image = {
      type: 'latlong' as const,
      width: 512,
      height: 256,
      data: new Float32Array(512 * 256 * 3).fill(1),
    };
    faults.memory = faults.bytes() + 10_000;
    ends.push(await end(viewer.setEnvironment(image)));
    // It is not tried again with the next change.
    viewer.environmentRotation = 1;
    faults.memory = undefined;
    ends.push(await end(viewer.setMaterial('right', { base_color: [0.02, 0.8, 0.02] })));
    return ends;
  });
  expect(ends).toEqual(['done', 'renderer/material', 'renderer/material', 'done', 'renderer/out-of-memory', 'done']);
  await done(page);
  expect((await shot(page)).cells).toEqual(before.cells);
  expect(await heard(page, 'error')).toEqual([]);
  // Nor after a loss.
  await page.evaluate(() => window.loseGpu());
  await expect.poll(async () => (await heard(page, 'device-restored')).length).toBe(1);
  await done(page);
  expect((await shot(page)).cells).toEqual(before.cells);
  // With memory it works.
  await page.evaluate(() =>
    window.viewer.setEnvironment({
      type: 'latlong',
      width: 64,
      height: 32,
      data: new Float32Array(64 * 32 * 3).fill(0.2),
    }),
  );
  await done(page);
  expect((await shot(page)).mean[0]).toBeLessThan(0.8 * before.mean[0]);
  expect(await page.evaluate(() => window.gpuFaults.errors)).toEqual([]);
});

test('destroy() at any moment, twice, frees everything, and ends what is waited for', async ({ page }) => {
  test.setTimeout(600_000);
  await injectFaults(page);
  await page.goto(served.origin);
  // A load, an edit, another size and another load, given up before the nth call of the GPU.
  const run = (at: number) =>
    page.evaluate(
      async ([bytes, stop]) => {
        const { gpuFaults: faults } = window;
        document.querySelector('canvas')!.replaceWith(document.createElement('canvas'));
        const canvas = document.querySelector('canvas')!;
        let calls = 0;
        const viewer = window.make({
          samples: 2,
          maxDepth: 2,
          pixelRatio: 0.25,
          environment: { type: 'constant', radiance: [1, 1, 1] },
        });
        faults.onCall = () => {
          if (++calls !== stop) return;
          queueMicrotask(() => {
            viewer.destroy();
            viewer.destroy();
          });
        };
        const ends: string[] = [];
        const end = async (work: () => Promise<unknown>) => {
          try {
            await work();
          } catch (error) {
            const { code, name } = error as { code?: string; name: string };
            // An abort has a number for a code.
            ends.push(typeof code === 'string' ? code : name);
          }
        };
        const settled = () =>
          new Promise<void>((resolve) => {
            const look = () =>
              viewer.state === 'done' || viewer.state === 'destroyed' ? resolve() : setTimeout(look, 20);
            look();
          });
        await end(() => viewer.load(window.file(bytes, 'model.glb')));
        await settled();
        await end(async () => viewer.setMaterial('left', { coat_weight: 0.5 }));
        await settled();
        canvas.style.width = '200px';
        await new Promise((resolve) => setTimeout(resolve, 60));
        await settled();
        await end(() => viewer.load(window.file(bytes, 'model.glb')));
        await settled();
        viewer.destroy();
        faults.onCall = undefined;
        await new Promise((resolve) => setTimeout(resolve, 60));
        return { calls, ends, state: viewer.state, live: faults.live() };
      },
      [base64, at] as const,
    );

  const whole = await run(-1);
  expect(whole).toMatchObject({ ends: [], state: 'destroyed', live: {} });
  const bad: string[] = [];
  const steps = process.env['GLANZ_FULL'] === undefined ? 5 : 10;
  for (let i = 0; i < steps; i++) {
    const at = 1 + Math.floor((whole.calls * i) / steps);
    const { ends, state, live } = await run(at);
    const expected = ends.every((code) => ['AbortError', 'viewer/destroyed', 'viewer/no-scene'].includes(code));
    if (!expected || state !== 'destroyed' || Object.keys(live).length > 0)
      bad.push(`before call ${at}: ${ends.join(', ')}; ${state}; left ${JSON.stringify(live)}`);
  }
  expect(bad).toEqual([]);
  expect(await page.evaluate(() => window.gpuFaults.errors)).toEqual([]);
  // Before there is a device, too.
  const early = await page.evaluate(async (bytes) => {
    const viewer = window.make();
    const load = viewer.load(window.file(bytes, 'model.glb')).then(
      () => 'loaded',
      (error: Error) => error.name,
    );
    viewer.destroy();
    const end = await load;
    await new Promise((resolve) => setTimeout(resolve, 300));
    return [end, window.gpuFaults.live()];
  }, base64);
  expect(early).toEqual(['AbortError', {}]);
});

test('the canvas releases a device before it is destroyed', async ({ page }) => {
  await page.addInitScript(() => {
    window.ownDevices = true;
    window.order = [];
    for (const [prototype, name] of [
      [GPUCanvasContext.prototype, 'unconfigure'],
      [GPUDevice.prototype, 'destroy'],
    ] as [object, string][]) {
      const original = (prototype as Record<string, () => void>)[name]!;
      Object.defineProperty(prototype, name, {
        value(this: object) {
          window.order.push(name);
          original.call(this);
        },
      });
    }
  });
  await open(page, served.origin);
  await page.evaluate(() => window.viewer.destroy());
  expect(await page.evaluate(() => window.order)).toEqual(['unconfigure', 'destroy']);
});

test('sizes of zero, one pixel and millions of pixels in sequence: the last one counts, and the GPU reports no error', async ({
  page,
}) => {
  await injectFaults(page);
  await open(page, served.origin);
  const sizes: [number, number][] = [
    [0, 0],
    [1, 1],
    [0, 100],
    [300, 0],
    [20_000, 20],
    [3, 4000],
    [0, 0],
    [320, 200],
  ];
  await page.evaluate(async (given) => {
    const canvas = document.querySelector('canvas')!;
    for (const [width, height] of given) {
      Object.assign(canvas.style, { width: `${width}px`, height: `${height}px` });
      await new Promise((resolve) => setTimeout(resolve, 120));
    }
    // The first size is the last one: the viewer must have seen it again.
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  }, sizes);
  await expect
    .poll(() => page.evaluate(() => [window.viewer.tracer!.width, window.viewer.tracer!.height]))
    .toEqual([80, 50]);
  await done(page);
  const after = await shot(page);
  await page.evaluate(() => window.viewer.destroy());
  expect(await page.evaluate(() => window.gpuFaults.errors)).toEqual([]);
  expect(await heard(page, 'error')).toEqual([]);
  await open(page, served.origin);
  expect((await shot(page)).cells).toEqual(after.cells);
});

test('in a tab that is hidden repeatedly nothing is submitted, and the image comes out the same', async ({ page }) => {
  await injectFaults(page);
  await open(page, served.origin, { samples: 40 });
  const film = () => page.evaluate(async () => Array.from(await window.viewer.tracer!.read('beauty')).join());
  const before = await film();
  await page.evaluate(() => window.viewer.setOrbit({ theta: 0.01 }, { immediate: true }));
  const submitted = await page.evaluate(async () => {
    const { gpuFaults: faults } = window;
    window.viewer.setOrbit({ theta: 0 }, { immediate: true });
    let late = 0;
    for (let i = 0; i < 20; i++) {
      faults.hide(true);
      // A batch of the GPU is waited for, however long it takes, and drawn.
      while (window.viewer.state !== 'hidden') await new Promise((resolve) => setTimeout(resolve, 5));
      // What was on its way may still come; a software GPU is slow.
      for (let calm = 0, seen = -1; calm < 5; seen = faults.count['submit'] ?? 0) {
        await new Promise((resolve) => setTimeout(resolve, 50));
        calm = seen === faults.count['submit'] ? calm + 1 : 0;
      }
      const before = faults.count['submit'] ?? 0;
      await new Promise((resolve) => setTimeout(resolve, 20 + ((i * 7) % 40)));
      late += (faults.count['submit'] ?? 0) - before;
      faults.hide(false);
      await new Promise((resolve) => setTimeout(resolve, (i * 13) % 50));
    }
    return late;
  });
  expect(submitted).toBe(0);
  await done(page);
  expect(await page.evaluate(() => window.viewer.sampleCount)).toBe(40);
  expect(await film()).toBe(before);
});

test('paused while the first samples of a view are on the GPU, it shows them, and goes on where it was', async ({
  page,
}) => {
  // Small, so that the first batch holds a whole sample.
  await open(page, served.origin);
  const before = await shot(page);
  for (const samples of [0, 1]) {
    const states = await page.evaluate(async (after) => {
      const { viewer } = window;
      const until = async (state: string) => {
        while (viewer.state !== state) await new Promise((resolve) => setTimeout(resolve, 10));
      };
      let refining = false;
      const offs = [
        viewer.on('state', ({ state }) => {
          refining = state === 'rendering';
          if (refining && after === 0) setTimeout(() => void (viewer.paused = true));
        }),
        viewer.on('sample', () => void (viewer.paused ||= refining && after > 0)),
      ];
      viewer.setOrbit({ theta: 0.3 }, { immediate: true });
      await until('paused');
      for (const off of offs) off();
      const kept = viewer.sampleCount;
      viewer.paused = false;
      viewer.setOrbit({ theta: 0 }, { immediate: true });
      await until('done');
      return { kept, done: viewer.sampleCount };
    }, samples);
    expect(states.kept).toBeGreaterThan(0);
    expect(states.done).toBe(6);
  }
  expect((await shot(page)).cells).toEqual(before.cells);
});

test('a GPU error outside of any call is reported by the error event, and the viewer keeps working', async ({
  page,
}) => {
  await injectFaults(page);
  await open(page, served.origin);
  await page.evaluate(() => window.gpuFaults.complain('something is wrong'));
  expect((await heard(page, 'error')).map(({ code, message }) => [code, message])).toEqual([
    ['viewer/gpu', 'The GPU reports: something is wrong'],
  ]);
  await page.evaluate(() => window.viewer.setMaterial('left', { base_color: [0.9, 0.9, 0.02] }));
  await done(page);
});

for (const change of ['camera', 'material'])
  test(`an image is not done while the kernels of its ${change} are compiled`, async ({ page }) => {
    // Pipelines wait while there is a gate.
    await page.addInitScript(() => {
      window.ownDevices = true;
      const { createComputePipelineAsync: create } = GPUDevice.prototype;
      GPUDevice.prototype.createComputePipelineAsync = async function (descriptor) {
        await window.gate;
        return create.call(this, descriptor);
      };
    });
    await open(page, served.origin);
    const before = await shot(page);
    // Both squares, at the left end of a wide view.
    const camera = { type: 'orthographic', name: 'wide', transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 0, 5, 1] };
    await page.evaluate(
      ([what, wide]) => {
        window.gate = new Promise((resolve) => (window.openGate = resolve));
        const moved = new Promise<void>((resolve) => {
          const off = window.viewer.on('state', ({ state }) => state === 'moving' && (off(), resolve()));
        });
        if (what === 'camera') window.viewer.setCamera({ ...wide, xmag: 6, ymag: 6 } as never, { immediate: true });
        else void window.viewer.setMaterial('left', { coat_weight: 1, coat_color: [0.02, 0.02, 0.9] });
        return moved;
      },
      [change, camera] as const,
    );
    // The view before has all its samples again, and is shown.
    const progress = () => page.evaluate(() => [window.viewer.state, window.viewer.sampleCount]);
    await expect.poll(progress).toEqual(['rendering', 6]);
    await page.waitForTimeout(300);
    expect((await shot(page)).cells).toEqual(before.cells);
    expect(await progress()).toEqual(['rendering', 6]);
    expect(await heard(page, 'converged')).toHaveLength(1);
    await page.evaluate(() => window.openGate());
    await done(page);
    const { cells } = await shot(page);
    const differences = cells.flat().map((code, i) => Math.abs(code - before.cells.flat()[i]!));
    expect(Math.max(...differences)).toBeGreaterThan(20);
    expect(await page.evaluate(() => window.viewer.sampleCount)).toBe(6);
    expect(await heard(page, 'converged')).toHaveLength(2);
  });

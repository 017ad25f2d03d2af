import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { hdr, injectFaults, pixelsOf, servePage, watch, type Served } from '@glanz/browser';
import { test } from '@glanz/browser/shared-device';
import { expect, type Page } from '@playwright/test';
import type { ViewerOptions } from '@glanz/viewer';
import { canvas, done, front, heard, model, open as openAt, settled, shot, sky } from './open';

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

const open = (page: Page, options?: ViewerOptions, bytes?: Buffer) => openAt(page, served.origin, options, bytes);

test('a model appears as it is, events report it, and the view is the one asked for', async ({ page }) => {
  await open(page);
  const { cells } = await shot(page);
  const [left, middle, right] = cells.slice(3, 6) as [number, number, number][];
  expect(left![0]).toBeGreaterThan(2 * left![1]);
  expect(right![1]).toBeGreaterThan(2 * right![0]);
  // Between them the white sky.
  expect(middle![2]).toBeGreaterThan(left![2]);
  const types = await page.evaluate(() => window.heard.map(({ type }) => type));
  expect(types.indexOf('load')).toBeLessThan(types.indexOf('sample'));
  const samples = (await heard(page, 'sample')).map((event) => event['samples'] as number);
  expect(samples.at(-1)).toBe(6);
  expect(samples).toEqual([...samples].sort((a, b) => a - b));
  expect(await heard(page, 'converged')).toEqual([expect.objectContaining({ samples: 6 })]);
  const totals = (await heard(page, 'progress')).map((event) => event['total'] as number);
  expect(Math.max(...totals)).toBe(1);
  expect(await heard(page, 'error')).toEqual([]);
  expect(
    (await heard(page, 'state')).map((event) => event['state']).filter((state, i, all) => state !== all[i - 1]),
  ).toEqual(['loading', 'moving', 'rendering', 'done']);
});

test('warms up until there is a model, where that is asked for or the adapter is not software', async ({ page }) => {
  await page.addInitScript(() => {
    window.ownDevices = true;
    window.kernels = [];
    // Bound again below.
    // eslint-disable-next-line @typescript-eslint/unbound-method
    const { createComputePipelineAsync } = GPUDevice.prototype;
    GPUDevice.prototype.createComputePipelineAsync = function (descriptor) {
      window.kernels.push(descriptor.label ?? '');
      return createComputePipelineAsync.call(this, descriptor);
    };
  });
  const images: Awaited<ReturnType<typeof shot>>[] = [];
  for (const warmUp of [undefined, true]) {
    await page.goto(served.origin);
    await page.evaluate((options) => void (window.viewer = window.make(options)), {
      samples: 6,
      maxDepth: 3,
      pixelRatio: 0.25,
      camera: front,
      environment: sky,
      ...(warmUp ? { warmUp } : {}),
    } as ViewerOptions);
    // The viewer's own comes with the device, and right before the rest where there is more.
    await expect
      .poll(() => page.evaluate(() => window.kernels))
      .toContain(warmUp ? 'glanz shade' : 'glanz viewer blend');
    if (!warmUp) await page.waitForTimeout(500);
    expect((await page.evaluate(() => window.kernels)).includes('glanz shade')).toBe(warmUp === true);
    // It is given up in the middle.
    await page.evaluate((base64) => window.viewer.load(window.file(base64, 'model.glb')), model.toString('base64'));
    await done(page);
    images.push(await shot(page));
  }
  expect(images[1]).toEqual(images[0]);
});

test('a drag turns the model: a small preview while it moves, then the image in full again', async ({ page }) => {
  await open(page);
  const before = await shot(page);
  await page.evaluate(() => void (window.heard = []));
  await page.mouse.move(160, 100);
  await page.mouse.down();
  await page.mouse.move(240, 100, { steps: 5 });
  await page.mouse.up();
  await expect.poll(async () => (await heard(page, 'converged')).length).toBeGreaterThan(0);
  await done(page);
  const after = await shot(page);
  const changes = await heard(page, 'camera-change');
  expect(changes.length).toBeGreaterThan(0);
  expect(changes.every((event) => event['source'] === 'user')).toBe(true);
  // Half a turn for the height of the canvas, to the left around the model.
  const turned = await page.evaluate(() => window.viewer.orbit!.theta);
  expect(turned).toBeCloseTo((-80 / 200) * Math.PI, 5);
  const moved =
    after.cells.reduce(
      (sum, cell, i) => sum + cell.reduce((all, value, k) => all + Math.abs(value - before.cells[i]![k]!), 0),
      0,
    ) / 27;
  expect(moved).toBeGreaterThan(5);
  expect((await heard(page, 'frame')).filter((event) => event['preview'])).not.toEqual([]);
  expect((await heard(page, 'frame')).at(-1)).toMatchObject({ preview: false, width: 80, height: 50 });
  // Back home, the same image as at first.
  await canvas(page).press('Home');
  await expect.poll(async () => Math.abs((await shot(page)).cells[3]![0] - before.cells[3]![0])).toBeLessThan(1.5);
});

test('keys, wheel and a double click move the camera as they should', async ({ page }) => {
  await open(page, { damping: 0 });
  const orbit = () => page.evaluate(() => window.viewer.orbit!);
  const first = await orbit();
  expect(first.radius).toBeCloseTo(5, 5);
  await canvas(page).press('ArrowRight');
  expect((await orbit()).theta).toBeCloseTo(Math.PI / 24, 5);
  await canvas(page).press('ArrowUp');
  expect((await orbit()).phi).toBeCloseTo(Math.PI / 2 - Math.PI / 24, 5);
  await canvas(page).press('0');
  await canvas(page).press('+');
  expect((await orbit()).radius).toBeCloseTo(5 / 1.12, 5);
  await page.mouse.move(160, 100);
  await page.mouse.wheel(0, 100);
  await expect.poll(async () => (await orbit()).radius).toBeCloseTo((5 / 1.12) * Math.exp(0.15), 3);
  await canvas(page).press('0');
  await done(page);
  // The middle of the left square.
  const at = await page.evaluate(() => window.viewer.project([-1.2, 0, 0])!);
  await canvas(page).dblclick({ position: { x: at.x * 320, y: at.y * 200 } });
  await expect.poll(async () => (await orbit()).target[0]).toBeCloseTo(-1.2, 1);
  await expect.poll(async () => (await heard(page, 'pick')).length).toBeGreaterThan(0);
  await canvas(page).press('Home');
  expect((await orbit()).target[0]).toBeCloseTo(0, 5);
});

test('two fingers pinch', async ({ page }) => {
  await open(page, { damping: 0 });
  const radius = () => page.evaluate(() => window.viewer.orbit!.radius);
  const before = await radius();
  await page.evaluate(() => {
    const target = document.querySelector('canvas')!;
    const send = (type: string, pointerId: number, clientX: number) =>
      target.dispatchEvent(
        new PointerEvent(type, { pointerId, clientX, clientY: 100, pointerType: 'touch', button: 0, bubbles: true }),
      );
    send('pointerdown', 1, 120);
    send('pointerdown', 2, 200);
    send('pointermove', 2, 280);
    send('pointerup', 1, 120);
    send('pointerup', 2, 280);
  });
  // From 80 pixels apart to 160: twice as near.
  expect(await radius()).toBeCloseTo(before / 2, 5);
});

/** CSS colours of a material; leaves it yellow. */
async function paintByName(page: Page): Promise<void> {
  const table = readFileSync(new URL('../../tonemap/src/css-color-names.ts', import.meta.url), 'utf8');
  const named = [...table.matchAll(/\b([a-z]+) ([0-9a-f]{6})\b/g)].map(
    ([, name, code]) => [name!, `#${code!}`] as const,
  );
  expect(named).toHaveLength(148);
  const { browser, ...found } = await page.evaluate(
    async (names) => {
      const { viewer } = window;
      const color = () => viewer.scene!.materials.find(({ name }) => name === 'right')!.parameters.base_color;
      const refused = (edit: object) =>
        viewer.setMaterial('right', edit).then(
          () => 'taken',
          ({ code, message }: { code: string; message: string }) => `${code}: ${message}`,
        );
      const context = new OffscreenCanvas(1, 1).getContext('2d')!;
      const browser = names.map((name) => ((context.fillStyle = name), context.fillStyle));
      // A number that comes after a text stays after it, although the text's parser has to be fetched first.
      const first = viewer.setMaterial('right', { base_color: 'rebeccapurple' });
      await new Promise((resolve) => requestAnimationFrame(resolve));
      await Promise.all([first, viewer.setMaterial('right', { base_color: [0.9, 0.9, 0.02] })]);
      const ordered = color();
      await viewer.setMaterial('right', { base_color: '#ff8000', coat_color: 'rgb(0 255 0)' });
      const orange = color();
      const wrong = await Promise.all(
        [
          { base_color: 'rebecapurple' },
          { base_color: '#ff800080' },
          { base_colour: 'red' },
          { base_metalness: 'red' },
        ].map(refused),
      );
      // Two edits of one frame, one of which is refused.
      const pair = await Promise.all([
        refused({ base_color: 'white', base_metalness: 2 }),
        refused({ specular_roughness: 0.4 }),
      ]);
      const kept = color();
      await viewer.setMaterial('right', { base_color: [0.9, 0.9, 0.02], coat_color: 'white' });
      return { browser, ordered, orange, wrong, pair, kept };
    },
    named.map(([name]) => name),
  );
  expect(browser).toEqual(named.map(([, code]) => code));
  expect(found.ordered).toEqual([0.9, 0.9, 0.02]);
  const orange = [1, ((128 / 255 + 0.055) / 1.055) ** 2.4, 0];
  orange.forEach((value, k) => expect(found.orange![k]).toBeCloseTo(value, 6));
  expect(found.kept).toEqual(found.orange);
  expect(found.wrong).toEqual([
    expect.stringMatching(
      /^tonemap\/color: Material "right" was not changed: base_color is "rebecapurple"; did you mean "rebeccapurple"\?/,
    ),
    expect.stringMatching(/^tonemap\/color: .*must be opaque/),
    expect.stringMatching(/^renderer\/material: .*did you mean "base_color"\?/),
    expect.stringMatching(/^renderer\/material: .*base_metalness/),
  ]);
  expect(found.pair).toEqual([expect.stringMatching(/^renderer\/material: .*base_metalness is 2/), 'taken']);
}

test('variant, material, exposure, environment and background reach the image', async ({ page }) => {
  await open(page);
  const right = async () => (await shot(page)).cells[5]!;
  const green = await right();
  await page.evaluate(() => window.viewer.setVariant('night'));
  await done(page);
  const blue = await right();
  expect(blue[2] - blue[1]).toBeGreaterThan(20);
  await page.evaluate(() => window.viewer.setVariant(undefined));
  await done(page);
  expect(Math.abs((await right())[1] - green[1])).toBeLessThan(2);

  await page.evaluate(() => window.viewer.setMaterial('right', { base_color: [0.9, 0.9, 0.02] }));
  await done(page);
  expect((await right())[0]).toBeGreaterThan(green[0] + 30);
  await paintByName(page);

  // Parts are hidden and shown, and take the material of others; the last call of a frame counts.
  const painted = await right();
  await page.evaluate(() => window.viewer.setVisibility('right', false));
  await done(page);
  const hidden = await right();
  expect(Math.abs(hidden[0] - painted[0]) + Math.abs(hidden[2] - painted[2])).toBeGreaterThan(30);
  await page.evaluate(() =>
    Promise.all([
      window.viewer.setVisibility('right', false),
      window.viewer.setVisibility('right', true),
      window.viewer.setPartMaterial('right', 'left'),
    ]),
  );
  await done(page);
  const red = await right();
  expect(red[0]).toBeGreaterThan(2 * red[1]);
  expect(
    await page.evaluate(() =>
      Promise.all([
        window.viewer.setVisibility('none', false).catch(({ code }: { code: string }) => code),
        window.viewer.setPartMaterial('right', 'none').catch(({ code }: { code: string }) => code),
      ]),
    ),
  ).toEqual(['renderer/instance', 'renderer/material']);
  await page.evaluate(() => window.viewer.setPartMaterial('right', 'right'));
  await done(page);

  const bright = await shot(page);
  await page.evaluate(() => void (window.viewer.exposure = -2));
  await expect.poll(async () => (await shot(page)).mean[0]).toBeLessThan(0.7 * bright.mean[0]);
  await page.evaluate(() => void (window.viewer.exposure = 0));

  // A file of red light; and then none of it behind the model, but the page.
  await page.evaluate(
    (base64) => window.viewer.setEnvironment(window.file(base64, 'red.hdr')),
    hdr([128, 0, 0, 129]).toString('base64'),
  );
  await done(page);
  const lit = await shot(page);
  expect(lit.mean[0]).toBeGreaterThan(4 * lit.mean[1]);

  // Turning it and changing its intensity goes without a pass over its texels; the fingerprint of a saved film reads
  // some.
  const reads = () =>
    page.evaluate(() => [
      Number(document.body.dataset['reads']),
      (window.viewer.tracer!.scene.environment as { intensity?: number }).intensity ?? 1,
    ]);
  await page.evaluate(() => {
    const texels = new Float32Array(64 * 32 * 3).map((_, i) => (i % 3 === 0 ? 1 : 0));
    const data = new Proxy(texels, {
      get(target, key) {
        if (typeof key === 'string' && /^\d+$/.test(key))
          document.body.dataset['reads'] = String(Number(document.body.dataset['reads'] ?? 0) + 1);
        const value: unknown = Reflect.get(target, key, target);
        return typeof value === 'function' ? value.bind(target) : value;
      },
    });
    return window.viewer.setEnvironment({ type: 'latlong', width: 64, height: 32, data });
  });
  const [set] = await reads();
  expect(set).toBeGreaterThanOrEqual(64 * 32 * 3);
  await page.evaluate(() => void Object.assign(window.viewer, { environmentRotation: 1, environmentIntensity: 0.5 }));
  await done(page);
  const [turned, intensity] = await reads();
  expect(intensity).toBe(0.5);
  expect(turned! - set!).toBeLessThan(64 * 32 * 3);
  await page.evaluate(() => void (window.viewer.background = 'transparent'));
  await done(page);
  await settled(page);
  const corner = (await pixelsOf(page, await page.screenshot({ clip: { x: 2, y: 2, width: 8, height: 8 } }))).mean;
  expect(corner.map(Math.round)).toEqual([0x20, 0x40, 0x80]);
});

test('resizing keeps the image sharp and the view whole', async ({ page }) => {
  await open(page);
  await page.evaluate(
    () => void Object.assign(document.querySelector('canvas')!.style, { width: '200px', height: '300px' }),
  );
  await expect
    .poll(() => page.evaluate(() => [window.viewer.tracer!.width, window.viewer.tracer!.height]))
    .toEqual([50, 75]);
  await done(page);
  const { cells } = await shot(page);
  expect(cells[3]![0]).toBeGreaterThan(1.2 * cells[3]![1]);
  expect(cells[5]![1]).toBeGreaterThan(1.2 * cells[5]![0]);
  // A box of no size draws nothing, and reports no error.
  await page.evaluate(() => void (document.querySelector('canvas')!.style.display = 'none'));
  await page.waitForTimeout(200);
  await page.evaluate(() => void (document.querySelector('canvas')!.style.display = 'block'));
  await expect.poll(() => page.evaluate(() => window.viewer.tracer!.width)).toBe(50);
});

test('the canvas has the size of the image when load() resolves, although nothing is drawn out of sight', async ({
  page,
}) => {
  await page.goto(served.origin);
  await page.evaluate(() => {
    const canvas = document.querySelector('canvas')!;
    Object.assign(canvas.style, { width: '300px', height: '200px', marginTop: '3000px' });
    window.viewer = window.make({ pixelRatio: 0.5 });
  });
  await expect.poll(() => page.evaluate(() => window.viewer.device !== undefined)).toBe(true);
  const size = await page.evaluate(async (base64) => {
    await window.viewer.load(window.file(base64, 'model.glb'));
    return [window.viewer.canvas.width, window.viewer.canvas.height, window.viewer.tracer!.samples];
  }, model.toString('base64'));
  expect(size).toEqual([150, 100, 0]);
});

test('out of sight nothing is computed; back in sight it continues', async ({ page }) => {
  await open(page, { samples: 4096 });
  await page.evaluate(() => void (document.querySelector('canvas')!.style.marginTop = '3000px'));
  await expect.poll(() => page.evaluate(() => window.viewer.state)).toBe('hidden');
  await page.waitForTimeout(150);
  const count = () => page.evaluate(() => window.heard.filter(({ type }) => type === 'sample').length);
  const hiddenCount = await count();
  await page.waitForTimeout(500);
  expect(await count()).toBe(hiddenCount);
  await page.evaluate(() => void (document.querySelector('canvas')!.style.marginTop = '0'));
  await expect.poll(count).toBeGreaterThan(hiddenCount);
});

test('a bad file is reported in one line with its code, and the former model stays', async ({ page }) => {
  await open(page);
  const before = await shot(page);
  const failed = await page.evaluate(() =>
    window.viewer.load(new File([new Uint8Array([1, 2, 3])], 'bad.glb')).then(
      () => 'loaded',
      (error: { code: string; message: string }) => `${error.code}: ${error.message}`,
    ),
  );
  expect(failed).toMatch(/^gltf\/(not-gltf|truncated): [^\n]+$/);
  expect(await heard(page, 'error')).toEqual([expect.objectContaining({ code: failed.split(':')[0] })]);
  await done(page);
  expect(Math.abs((await shot(page)).mean[0] - before.mean[0])).toBeLessThan(1);
  // A load that is overtaken ends as an abort, and is no error to show.
  const ends = await page.evaluate(async (base64) => {
    const one = window.viewer.load(window.file(base64, 'one.glb')).catch((error: Error) => error.name);
    const two = window.viewer.load(window.file(base64, 'two.glb'));
    return [await one, (await two).instances.length];
  }, model.toString('base64'));
  expect(ends).toEqual(['AbortError', 2]);
  expect(await heard(page, 'error')).toHaveLength(1);
});

test('a lost device comes back with the scene as it was edited, and its variant', async ({ page }) => {
  await injectFaults(page);
  await open(page);
  await page.evaluate(() =>
    Promise.all([
      window.viewer.setVariant('night'),
      window.viewer.setMaterial('left', { base_color: [0.9, 0.9, 0.02] }),
    ]),
  );
  await done(page);
  const before = await shot(page);
  const device = await page.evaluateHandle(() => window.viewer.device);
  await page.evaluate(() => window.loseGpu());
  await expect.poll(async () => (await heard(page, 'device-restored')).length).toBe(1);
  expect(await heard(page, 'device-lost')).toHaveLength(1);
  expect(await page.evaluate((former) => window.viewer.device !== former, device)).toBe(true);
  await done(page);
  const after = await shot(page);
  after.cells.forEach((cell, i) =>
    cell.forEach((mean, k) => expect(Math.abs(mean - before.cells[i]![k]!), `cell ${i}, channel ${k}`).toBeLessThan(2)),
  );
  // The variant can still be taken off.
  await page.evaluate(() => window.viewer.setVariant(undefined));
  await done(page);
  const green = (await shot(page)).cells[5]!;
  expect(green[1]).toBeGreaterThan(1.5 * green[2]);
});

test('a GPU process that crashes while the page starts is requested again; a missing GPU is reported', async ({
  page,
}) => {
  // As when the GPU's process ends: for a while no adapter, then one whose device does not come.
  await page.addInitScript(() => {
    const { requestAdapter } = GPU.prototype;
    const { requestDevice } = GPUAdapter.prototype;
    const asked = Object.assign(window, { adapters: 0, devices: 0, never: location.search === '?never' });
    GPU.prototype.requestAdapter = async function (...given) {
      return ++asked.adapters === 1 || asked.never ? null : requestAdapter.apply(this, given);
    };
    GPUAdapter.prototype.requestDevice = async function (...given) {
      if (++asked.devices === 1)
        throw new DOMException('A valid external Instance reference no longer exists.', 'OperationError');
      return requestDevice.apply(this, given);
    };
  });
  await open(page);
  expect((await shot(page)).cells[3]![0]).toBeGreaterThan(50);
  expect(await heard(page, 'error')).toEqual([]);
  expect(
    await page.evaluate(() => [
      (window as unknown as { adapters: number }).adapters,
      (window as unknown as { devices: number }).devices,
    ]),
  ).toEqual([3, 2]);

  await page.goto(`${served.origin}/?never`);
  const code = await page.evaluate(
    (base64) =>
      window
        .make()
        .load(window.file(base64, 'model.glb'))
        .catch((error: { code: string }) => error.code),
    model.toString('base64'),
  );
  expect(code).toBe('renderer/no-adapter');
});

/** Images that are not the one on the screen, which keeps its samples meanwhile. */
async function saveAtOtherSizes(page: Page): Promise<void> {
  await page.evaluate(() => void (window.viewer.pixelRatio = 0.2));
  await expect
    .poll(() => page.evaluate(() => [window.viewer.tracer!.width, window.viewer.state]))
    .toEqual([64, 'done']);
  const made = await page.evaluate(async () => {
    const { viewer } = window;
    const look = async (blob: Blob) => {
      const bitmap = await createImageBitmap(blob);
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d')!;
      context.drawImage(bitmap, 0, 0);
      return { size: [bitmap.width, bitmap.height], corner: context.getImageData(0, 0, 1, 1).data[3], type: blob.type };
    };
    const bytes = async (blob: Blob) => Array.from(new Uint8Array(await blob.arrayBuffer())).join();
    const progress: { samples: number; target: number; share: number }[] = [];
    const onProgress = ({ samples, target, share }: { samples: number; target: number; share: number }) =>
      void progress.push({ samples, target, share });
    const large = await look(
      await viewer.toBlob({
        width: 90,
        height: 60,
        samples: 6,
        background: 'environment',
        type: 'image/webp',
        onProgress,
      }),
    );
    const tall = await look(await viewer.toBlob({ height: 50 }));
    const noise = await look(await viewer.toBlob({ width: 32, noise: 10 }));
    const stop = new AbortController();
    const aborted = await viewer
      .toBlob({ width: 64, samples: 10_000, signal: stop.signal, onProgress: () => stop.abort(new Error('enough')) })
      .catch(String);
    const refused = await Promise.all(
      [{ width: 0.5 }, { height: Number.NaN }, { width: 70_000 }, { quality: 2 }, { noise: -1 }].map((options) =>
        viewer.toBlob(options).catch(({ code }: { code: string }) => code),
      ),
    );
    const after = [viewer.sampleCount, viewer.state];
    // More samples than the screen gets: rendered separately, and the same as on a screen that gets as many.
    const apart = await bytes(await viewer.toBlob({ samples: 8 }));
    viewer.samples = 8;
    const screen = await bytes(await viewer.toBlob());
    viewer.samples = 4;
    return {
      large,
      tall,
      noise,
      aborted,
      refused,
      after,
      progress,
      same: apart === screen,
      paused: await (async () => {
        viewer.paused = true;
        viewer.samples = 9;
        const { size } = await look(await viewer.toBlob());
        viewer.paused = false;
        viewer.autoRotate = 1;
        await look(await viewer.toBlob({ samples: 5 }));
        viewer.autoRotate = 0;
        return size;
      })(),
    };
  });
  expect(made).toMatchObject({
    large: { size: [90, 60], corner: 255, type: 'image/webp' },
    tall: { size: [80, 50], corner: 0 },
    noise: { size: [32, 20] },
    aborted: 'Error: enough',
    refused: Array<string>(5).fill('viewer/option'),
    after: [2, 'done'],
    same: true,
    paused: [64, 40],
  });
  expect(made.progress.at(-1)).toEqual({ samples: 6, target: 6, share: 1 });
  expect(made.progress.every(({ share }, k) => k === 0 || share >= made.progress[k - 1]!.share)).toBe(true);
  expect(await heard(page, 'error')).toEqual([]);
}

test('toBlob gives the image as a file; destroy ends everything, twice if need be', async ({ page }) => {
  await open(page, { background: 'transparent', pixelRatio: 1, samples: 2 });
  const shown = await shot(page);
  const file = await page.evaluate(async () => {
    const blob = await window.viewer.toBlob({ samples: 2 });
    const bitmap = await createImageBitmap(blob);
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d')!;
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    const at = (x: number, y: number) =>
      Array.from(data.slice(4 * (y * bitmap.width + x), 4 * (y * bitmap.width + x) + 4));
    return { type: blob.type, width: bitmap.width, height: bitmap.height, corner: at(2, 2), left: at(100, 100) };
  });
  expect(file).toMatchObject({ type: 'image/png', width: 320, height: 200 });
  // Nothing in the corner; red, and all of it, on the square.
  expect(file.corner[3]).toBe(0);
  expect(file.left[3]).toBe(255);
  expect(file.left[0]).toBeGreaterThan(2 * file.left[1]!);
  expect(shown.width).toBe(320);
  await saveAtOtherSizes(page);
  const lost = await page.evaluate(async () => {
    const { device } = window.viewer;
    window.viewer.destroy();
    window.viewer.destroy();
    const late = await window.viewer.load('x.glb').catch((error: { code: string }) => error.code);
    return [(await device!.lost).reason, window.viewer.state, late];
  });
  expect(lost).toEqual(['destroyed', 'destroyed', 'viewer/destroyed']);
  // The canvas serves another one.
  await open(page);
});

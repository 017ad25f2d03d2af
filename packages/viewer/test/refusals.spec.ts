import { fileURLToPath } from 'node:url';
import { crc32, deflateSync } from 'node:zlib';
import { injectFaults, quads, servePage, watch, type Served } from '@glanz/browser';
import { test } from '@glanz/browser/shared-device';
import { expect } from '@playwright/test';
import type { PerspectiveCamera } from '@glanz/scene';
import { done, heard, model, open, shot } from './open';

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

test('setters refuse what they cannot be, with a typed error, and nothing changes', async ({ page }) => {
  await open(page, served.origin);
  const before = await shot(page);
  const result = await page.evaluate(() => {
    const viewer = window.viewer as unknown as Record<string, unknown> & typeof window.viewer;
    const wrong = [NaN, Infinity, -Infinity, 1e30, -1e30, '2', null, {}, [1], true];
    const setters = [
      'exposure',
      'environmentIntensity',
      'environmentRotation',
      'samples',
      'maxDepth',
      'pixelRatio',
      'noise',
      'damping',
      'autoRotate',
      'autoRotateDelay',
      'fieldOfView',
      'toneMap',
      'background',
      'orbitLimits',
    ];
    const taken: string[] = [];
    const untyped: string[] = [];
    const attempt = (what: string, run: () => unknown) => {
      try {
        run();
        taken.push(what);
      } catch (error) {
        const { code, message } = error as { code?: unknown; message: string };
        if (typeof code !== 'string' || !/^(viewer|tonemap)\//.test(code) || message.includes('\n'))
          untyped.push(`${what}: ${String(error)}`);
      }
    };
    const stateOf = () => JSON.stringify([...setters.map((name) => [name, viewer[name]]), viewer.orbit, viewer.camera]);
    const state = stateOf();
    for (const name of setters)
      for (const value of wrong) {
        // No limits are limits.
        if (name === 'orbitLimits' && typeof value === 'object' && value !== null && !Array.isArray(value)) continue;
        if (name === 'orbitLimits' && Array.isArray(value)) continue;
        attempt(`${name} = ${String(value)}`, () => void (viewer[name] = value));
      }
    const { camera } = viewer;
    for (const value of wrong as never[]) {
      for (const field of ['theta', 'phi', 'radius', 'zoom', 'target'])
        attempt(`setOrbit ${field} ${String(value)}`, () => viewer.setOrbit({ [field]: value }));
      attempt(`setOrbit target[1] ${String(value)}`, () => viewer.setOrbit({ target: [0, value, 0] }));
      attempt(`camera at ${String(value)}`, () =>
        viewer.setCamera({ ...camera!, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, value, 5, 1] }),
      );
      attempt(`camera of ${String(value)}`, () => viewer.setCamera({ ...(camera as PerspectiveCamera), yfov: value }));
      attempt(`camera ${String(value)}`, () => viewer.setCamera(value));
      attempt(`direction ${String(value)}`, () => viewer.frame({ direction: [0, value, value] }));
      for (const limit of ['theta', 'phi', 'radius'])
        attempt(`limit ${String(value)}`, () => void (viewer.orbitLimits = { [limit]: value }));
    }
    attempt('radius 0', () => viewer.setOrbit({ radius: 0 }));
    attempt('yfov π', () => void (viewer.fieldOfView = Math.PI));
    attempt('yfov 0', () => void (viewer.fieldOfView = 0));
    attempt('flat camera', () => viewer.setCamera({ ...camera!, transform: new Float32Array(16) }));
    attempt('limits the wrong way round', () => void (viewer.orbitLimits = { phi: [2, 1] }));
    attempt('limit NaN', () => void (viewer.orbitLimits = { phi: [NaN, 1] }));
    for (const value of [NaN, Infinity, '2'] as never[]) attempt(`pick ${String(value)}`, () => viewer.focus(value, 3));
    for (const value of [NaN, 1e30, '2', null] as never[]) {
      for (const name of [
        'exposure',
        'samples',
        'maxDepth',
        'pixelRatio',
        'maxPixels',
        'environmentIntensity',
        'toneMap',
        'background',
        'damping',
        'maxSubmitMs',
      ]) {
        attempt(`option ${name} ${String(value)}`, () => window.make({ [name]: value }).destroy());
      }
      attempt(`option preview ${String(value)}`, () => window.make({ preview: { budgetMs: value } }).destroy());
    }
    return { taken, untyped, same: stateOf() === state };
  });
  expect(result).toEqual({ taken: [], untyped: [], same: true });
  await done(page);
  expect((await shot(page)).cells).toEqual(before.cells);
  expect(await heard(page, 'error')).toEqual([]);
});

test('a viewer whose options are refused does not request a device', async ({ page }) => {
  await open(page, served.origin);
  const result = await page.evaluate(() => {
    let requests = 0;
    const requestDevice = () => {
      requests++;
      return Promise.reject(new Error('requested'));
    };
    const codes = [{ orbitLimits: { phi: [2, 1] as [number, number] } }, { samples: NaN }].map((wrong) => {
      try {
        window.make({ ...wrong, requestDevice }).destroy();
        return 'taken';
      } catch (error) {
        return (error as { code?: unknown }).code;
      }
    });
    return { codes, requests };
  });
  expect(result).toEqual({ codes: ['viewer/camera', 'viewer/option'], requests: 0 });
});

test('sources of models and environments that are none reject with a typed error', async ({ page }) => {
  await open(page, served.origin);
  const before = await shot(page);
  const codes = await page.evaluate(async () => {
    const { viewer } = window;
    const end = (work: Promise<unknown>) =>
      work.then(
        () => 'done',
        (error: { code?: string }) => error.code ?? String(error),
      );
    const ends: string[] = [];
    for (const source of [42, null, undefined, {}, [1], 'http://[.obj'] as never[])
      ends.push(await end(viewer.load(source)));
    for (const source of [42, null, undefined, {}, [1], { type: 'cube' }, 'http://['] as never[])
      ends.push(await end(viewer.setEnvironment(source)));
    ends.push(await end(viewer.toBlob({ samples: NaN })));
    return ends;
  });
  expect(codes).toEqual([
    ...Array<string>(6).fill('viewer/no-model'),
    ...Array<string>(7).fill('viewer/environment'),
    'viewer/option',
  ]);
  await done(page);
  expect((await shot(page)).cells).toEqual(before.cells);
});

test('an environment, a variant or a tone map that is refused is not kept: later edits and a lost GPU work', async ({
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
    ends.push(await end(viewer.setEnvironment({ type: 'constant', radiance: [NaN, 1, 1] })));
    viewer.environmentRotation = 0.5;
    viewer.environmentRotation = 0;
    // Of two edits of one kind in one frame, one is refused.
    ends.push(...(await Promise.all([viewer.setVariant('night'), viewer.setVariant('noon')].map(end))));
    ends.push(await end(viewer.setVariant(undefined)));
    // A shader that does not compile.
    faults.failPipelines = 'tonemap agx';
    const failed = new Promise<string>((resolve) => viewer.on('error', ({ code }) => resolve(code), { once: true }));
    viewer.toneMap = 'agx';
    ends.push(await failed, viewer.toneMap);
    window.loseGpu();
    await new Promise<void>((resolve) => viewer.on('device-restored', () => resolve(), { once: true }));
    return ends;
  });
  expect(ends).toEqual(['scene/not-finite', 'done', 'renderer/variant', 'done', 'tonemap/pipeline', 'neutral']);
  await done(page);
  expect((await shot(page)).cells).toEqual(before.cells);
  expect((await heard(page, 'error')).map(({ code }) => code)).toEqual(['tonemap/pipeline']);
});

test('a display whose shaders never compile is a typed error of load(), and works once they do', async ({ page }) => {
  await injectFaults(page);
  await page.goto(served.origin);
  for (const [label, code] of [
    ['tonemap', 'tonemap/pipeline'],
    ['viewer blend', 'viewer/gpu'],
  ] as const) {
    const end = await page.evaluate(
      async ([pipeline, bytes]) => {
        window.gpuFaults.failPipelines = pipeline;
        const viewer = (window.viewer = window.make({
          samples: 2,
          pixelRatio: 0.25,
          environment: { type: 'constant', radiance: [1, 1, 1] },
        }));
        const reported: string[] = [];
        viewer.on('error', (event) => void reported.push(event.code));
        const load = () =>
          viewer.load(window.file(bytes, 'model.glb')).then(
            () => 'loaded',
            (error: { code?: string }) => error.code ?? String(error),
          );
        const first = await load();
        window.gpuFaults.failPipelines = undefined;
        const second = await load();
        viewer.destroy();
        await new Promise((resolve) => setTimeout(resolve, 50));
        return { first, reported, second, live: window.gpuFaults.live() };
      },
      [label, base64] as const,
    );
    expect(end).toEqual({ first: code, reported: [code], second: 'loaded', live: {} });
  }
});

test('of two environments that are asked for, the later one is shown, and the earlier one ends at once', async ({
  page,
}) => {
  await open(page, served.origin);
  // The first one takes for ever.
  await page.route('**/slow.hdr', () => undefined);
  const ends = await page.evaluate(async () => {
    const { viewer } = window;
    const name = (error: Error) => error.name;
    const slow = viewer.setEnvironment('slow.hdr').catch(name);
    const quick = viewer.setEnvironment({ type: 'constant', radiance: [1, 0, 0] }).then(() => 'done');
    const ended = await Promise.all([slow, quick]);
    const control = new AbortController();
    const aborted = viewer.setEnvironment('slow.hdr', { signal: control.signal }).catch(name);
    control.abort();
    return [...ended, await aborted];
  });
  expect(ends).toEqual(['AbortError', 'done', 'AbortError']);
  await done(page);
  const { mean } = await shot(page);
  expect(mean[0]).toBeGreaterThan(4 * mean[1]);
});

test('textures beyond a budget are a warning, once, and are shown without their largest levels', async ({ page }) => {
  const size = 1024;
  const chunk = (type: string, data: Buffer) => {
    const body = Buffer.concat([Buffer.from(type), data]);
    const framed = Buffer.alloc(body.length + 8);
    framed.writeUInt32BE(data.length, 0);
    body.copy(framed, 4);
    framed.writeUInt32BE(crc32(body), body.length + 4);
    return framed;
  };
  const header = Buffer.alloc(13);
  header.writeUInt32BE(size, 0);
  header.writeUInt32BE(size, 4);
  header.set([8, 2], 8);
  const row = Buffer.concat([Buffer.of(0), Buffer.alloc(3 * size, Buffer.of(10, 200, 10))]);
  const png = Buffer.concat([
    Buffer.of(0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a),
    chunk('IHDR', header),
    chunk('IDAT', deflateSync(Buffer.concat(Array.from({ length: size }, () => row)))),
    chunk('IEND', Buffer.alloc(0)),
  ]);
  const textured = quads([{ name: 'left', colour: [1, 1, 1], at: [0, 0, 0] }], (json) => {
    Object.assign(json, {
      images: [{ uri: `data:image/png;base64,${png.toString('base64')}` }],
      textures: [{ source: 0 }],
    });
    const [material] = json['materials'] as { pbrMetallicRoughness: object }[];
    Object.assign(material!.pbrMetallicRoughness, { baseColorTexture: { index: 0 } });
  });
  await open(page, served.origin, { samples: 2, tracer: { memory: { budgetMiB: 2 } } }, textured);
  expect(await heard(page, 'error')).toEqual([]);
  expect(await heard(page, 'warning')).toEqual([
    {
      type: 'warning',
      code: 'renderer/textures-reduced',
      message: expect.stringMatching(/1 texture .*1\.3 MiB.*5\.3 MiB/),
    },
  ]);
  const { mean } = await shot(page);
  // The image is green; without its texture the square would be white, as what is behind it.
  expect(mean[1]! - mean[0]!).toBeGreaterThan(20);
});

test('an environment that is missing or broken is a warning, and the studio lights the model', async ({ page }) => {
  await page.route('**/missing.hdr', (route) => route.fulfill({ status: 404, body: 'nothing' }));
  await page.route('**/broken.exr', (route) =>
    route.fulfill({ body: Buffer.from([0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0, 9, 9, 9]) }),
  );
  await open(page, served.origin, { environment: 'studio', samples: 2 });
  const studio = await shot(page);
  for (const [environment, why] of [
    ['missing.hdr', /could not be fetched/],
    ['broken.exr', /EXR/],
  ] as const) {
    await open(page, served.origin, { environment, samples: 2 });
    expect(await heard(page, 'load')).toHaveLength(1);
    expect(await heard(page, 'error')).toEqual([]);
    expect(await heard(page, 'warning')).toEqual([
      { type: 'warning', code: 'viewer/environment', message: expect.stringMatching(why) },
    ]);
    const { cells } = await shot(page);
    cells.forEach((cell, i) =>
      cell.forEach((value, k) => expect(Math.abs(value - studio.cells[i]![k]!)).toBeLessThan(2)),
    );
  }
  // A call that waits for its environment gets the error.
  expect(
    await page.evaluate(() =>
      window.viewer.setEnvironment('missing.hdr').catch((error: { code: string }) => error.code),
    ),
  ).toBe('viewer/environment');
  // And a broken model is an error, whatever lights it.
  expect(
    await page.evaluate(() =>
      window.viewer.load(new File(['no'], 'bad.glb')).catch((error: { code: string }) => error.code),
    ),
  ).toMatch(/^gltf\//);
  expect(await heard(page, 'error')).toHaveLength(1);
  expect(await heard(page, 'warning')).toHaveLength(1);
  complaints = complaints.filter((text) => !text.includes('404'));
});

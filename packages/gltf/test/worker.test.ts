import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { chromium, type Browser, type Page } from 'playwright';
import { build } from 'esbuild';
import sharp from 'sharp';
import { afterAll, beforeAll, expect, test } from 'vitest';
import config from '../../../playwright.config';
import type { GltfWorker, loadGltfInWorker } from '../src/worker/load';
import { glb, spoiled, triangle } from './build';
import { presence, sharedPath } from './shared';

let server: Server, browser: Browser, page: Page;
const pages = new Map<string, string | Uint8Array>();
const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));

beforeAll(async () => {
  const { outputFiles } = await build({
    stdin: {
      contents: `import { GltfWorker, loadGltfInWorker } from ${JSON.stringify(here('../src/worker/load.ts'))}; import { loadGltf } from ${JSON.stringify(here('../src/load.ts'))}; Object.assign(globalThis, { GltfWorker, loadGltf, loadGltfInWorker });`,
      resolveDir: here('.'),
    },
    bundle: true,
    write: false,
    format: 'esm',
    conditions: ['@glanz/source'],
  });
  const own = await build({
    entryPoints: [here('../src/worker/worker.ts')],
    bundle: true,
    write: false,
    format: 'esm',
    conditions: ['@glanz/source'],
  });
  const decoding = await build({
    stdin: {
      contents: `import { serveGltf } from ${JSON.stringify(here('../src/worker/worker.ts'))}; serveGltf({ decoders: { meshopt: async () => (await import('meshoptimizer/decoder')).MeshoptDecoder } });`,
      resolveDir: here('.'),
    },
    bundle: true,
    write: false,
    format: 'esm',
    conditions: ['@glanz/source'],
  });
  pages
    .set('/', '<!doctype html><script type="module" src="entry.js"></script>')
    .set('/entry.js', outputFiles[0]!.contents)
    .set('/worker.js', own.outputFiles[0]!.contents)
    .set('/decoding.js', decoding.outputFiles[0]!.contents);
  server = createServer((request, response) => {
    const body = pages.get(request.url!);
    response
      .writeHead(body === undefined ? 404 : 200, {
        'content-type': request.url!.endsWith('.js')
          ? 'text/javascript'
          : request.url === '/'
            ? 'text/html'
            : 'application/octet-stream',
        // No blob:, no eval, no other origin.
        'content-security-policy':
          "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; connect-src 'self'",
      })
      .end(body);
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  browser = await chromium.launch(config.use!.launchOptions!);
  page = await browser.newPage();
  await page.goto(`http://127.0.0.1:${(server.address() as AddressInfo).port}/`);
  await page.waitForFunction(() => 'loadGltfInWorker' in globalThis);
});

afterAll(async () => {
  await browser?.close();
  server?.close();
});

interface Result {
  readonly code?: string;
  readonly message?: string;
  readonly instances?: number;
  readonly triangles?: number;
  readonly images?: number;
  readonly stages?: string[];
}

const load = (path: string, options: { readonly worker?: string; readonly abort?: boolean } = {}): Promise<Result> =>
  page.evaluate(
    async ({ path: address, worker, abort }) => {
      const controller = new AbortController();
      const stages = new Set<string>();
      try {
        const promise = (globalThis as unknown as { loadGltfInWorker: typeof loadGltfInWorker }).loadGltfInWorker(
          address,
          {
            signal: controller.signal,
            onProgress: ({ stage }) => stages.add(stage),
            ...(worker ? { createWorker: () => new Worker(worker, { type: 'module' }) } : {}),
          },
        );
        if (abort) controller.abort();
        const scene = await promise;
        return {
          instances: scene.instances.length,
          triangles: scene.meshes.reduce((sum, { indices }) => sum + indices.length / 3, 0),
          images: scene.images.length,
          stages: [...stages],
        };
      } catch (error) {
        return {
          ...((error as { code?: string }).code === undefined
            ? {}
            : { code: String((error as { code?: string }).code) }),
          message: (error as Error).message,
        };
      }
    },
    { path, ...options },
  );

test('a document by a relative address, under a policy without blob:', async () => {
  pages.set(
    '/m/a.glb',
    spoiled(() => undefined),
  );
  expect(await load('m/a.glb')).toMatchObject({ instances: 1, triangles: 1, stages: ['read', 'decode'] });
});

test('errors keep class, code and message', async () => {
  pages.set('/m/short.glb', glb(triangle().json, new Uint8Array(8)));
  expect(await load('m/short.glb')).toMatchObject({
    code: 'gltf/truncated',
    message: expect.stringMatching(/short\.glb/),
  });
  expect(await load('m/none.glb')).toMatchObject({ code: 'gltf/missing-resource' });
});

test('a worker that cannot be started is an error; an abort rejects with its reason', async () => {
  expect(await load('m/a.glb', { worker: '/none.js' })).toMatchObject({ code: 'gltf/worker' });
  expect((await load('m/a.glb', { abort: true })).message).toMatch(/abort/i);
});

test('one worker is kept between loads; loads at a time have one each; an abort or a fault costs a worker, not the next load', async () => {
  pages.set(
    '/m/a.glb',
    spoiled(() => undefined),
  );
  const outcome = await page.evaluate(async () => {
    const Loader = (globalThis as unknown as { GltfWorker: typeof GltfWorker }).GltfWorker;
    let started = 0;
    const loader = new Loader({
      createWorker: () => {
        started++;
        return new Worker('/worker.js', { type: 'module', name: 'glanz-gltf' });
      },
    });
    const outcome = (promise: Promise<{ instances: unknown[] }>) =>
      promise.then(
        ({ instances }) => instances.length as number | string,
        (error: Error & { code?: string }) => (error.name === 'AbortError' ? error.name : (error.code ?? error.name)),
      );
    const one = [
      await outcome(loader.load('m/a.glb')),
      await outcome(loader.load('m/none.glb')),
      await outcome(loader.load('m/a.glb')),
      started,
    ];
    const two = [...(await Promise.all([outcome(loader.load('m/a.glb')), outcome(loader.load('m/a.glb'))])), started];
    const controller = new AbortController();
    const aborted = outcome(loader.load('m/a.glb', { signal: controller.signal }));
    controller.abort();
    const three = [await aborted, await outcome(loader.load('m/a.glb')), started];
    const pending = outcome(loader.load('m/a.glb'));
    loader.destroy();
    return [...one, ...two, ...three, await pending, await outcome(loader.load('m/a.glb'))];
  });
  expect(outcome).toEqual([
    1,
    'gltf/missing-resource',
    1,
    1,
    1,
    1,
    2,
    'AbortError',
    1,
    3,
    'gltf/worker',
    'gltf/worker',
  ]);
});

test('images are sent as bitmaps; their pixels can be read after the transfer', async () => {
  const { json, binary } = triangle();
  const image = await sharp(Uint8Array.of(200, 40, 90, 0, 10, 20, 30, 255), {
    raw: { width: 2, height: 1, channels: 4 },
  })
    .png()
    .toBuffer();
  json['images'] = [{ uri: `data:image/png;base64,${image.toString('base64')}` }];
  json['textures'] = [{ source: 0 }];
  json['materials'] = [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }];
  json['meshes'][0].primitives[0].material = 0;
  pages.set('/m/image.glb', glb(json, binary));
  const images = await page.evaluate(async () => {
    const scene = await (globalThis as unknown as { loadGltfInWorker: typeof loadGltfInWorker }).loadGltfInWorker(
      'm/image.glb',
    );
    return scene.images.map(({ bitmap, width, height, data }) => [
      bitmap instanceof ImageBitmap,
      width,
      height,
      ...data,
    ]);
  });
  expect(images).toEqual([[true, 2, 1, 200, 40, 90, 0, 10, 20, 30, 255]]);
});

const { present, note } = presence('assets/index.json');

test.skipIf(!present)(
  `a compressed model by a worker of one's own with a decoder; without, the package to install${note}`,
  async () => {
    pages.set('/m/packed.glb', readFileSync(sharedPath('assets/BoxTextured-meshopt/BoxTextured_meshopt.glb')));
    expect(await load('m/packed.glb', { worker: '/decoding.js' })).toMatchObject({ triangles: 12, images: 1 });
    expect(await load('m/packed.glb')).toMatchObject({
      code: 'gltf/missing-decoder',
      message: expect.stringMatching(/meshoptimizer/),
    });
  },
);

// How long the thread is busy is what `npm run bench -- gltf` measures.
test.skipIf(!present)(`the page's own thread neither reads the document nor decodes images${note}`, async () => {
  pages.set('/m/helmet.glb', readFileSync(sharedPath('assets/DamagedHelmet/DamagedHelmet.glb')));
  await page.evaluate(() => {
    const calls = ((globalThis as { calls?: string[] }).calls = [] as string[]);
    const spy = (holder: object, name: string) => {
      const real = Reflect.get(holder, name) as (...given: unknown[]) => unknown;
      Reflect.set(holder, name, function (this: unknown, ...given: unknown[]) {
        calls.push(name);
        return real.apply(this, given);
      });
    };
    spy(globalThis, 'createImageBitmap');
    spy(JSON, 'parse');
    spy(TextDecoder.prototype, 'decode');
    spy(Blob.prototype, 'arrayBuffer');
  });
  expect(await load('m/helmet.glb')).toMatchObject({ triangles: 15452, images: 4 });
  expect(await page.evaluate(() => (globalThis as { calls?: string[] }).calls)).toEqual([]);
  // The spies do hear what a load on this thread does.
  await page.evaluate(() =>
    (globalThis as unknown as { loadGltf: (address: string) => Promise<unknown> }).loadGltf('m/helmet.glb'),
  );
  expect(new Set(await page.evaluate(() => (globalThis as { calls?: string[] }).calls))).toEqual(
    new Set(['decode', 'parse', 'createImageBitmap', 'arrayBuffer']),
  );
});

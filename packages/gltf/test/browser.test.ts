import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { fileURLToPath } from 'node:url';
import { chromium, type Browser, type Page } from 'playwright';
import { build } from 'esbuild';
import sharp from 'sharp';
import { afterAll, beforeAll, expect, test } from 'vitest';
import config from '../../../playwright.config';
import type { loadGltf } from '../src/index';
import { glb, triangle } from './build';

let server: Server, browser: Browser, page: Page;
const pages = new Map<string, string | Uint8Array>();

/** The triangle with a material whose image is a file beside it, as a .gltf beside its buffer. */
function textured(): string {
  const { json } = triangle();
  json['buffers'][0].uri = 'triangle.bin';
  json['images'] = [{ uri: 'image.png' }];
  json['textures'] = [{ source: 0 }];
  json['materials'] = [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }];
  json['meshes'][0].primitives[0].material = 0;
  return JSON.stringify(json);
}

beforeAll(async () => {
  const { outputFiles } = await build({
    stdin: {
      contents: `import { loadGltf } from ${JSON.stringify(fileURLToPath(new URL('../src/index.ts', import.meta.url)))}; globalThis.loadGltf = loadGltf;`,
      resolveDir: fileURLToPath(new URL('.', import.meta.url)),
    },
    bundle: true,
    write: false,
    format: 'iife',
    conditions: ['@glanz/source'],
  });
  pages.set('/', '<!doctype html><script src="entry.js"></script>').set('/entry.js', outputFiles[0]!.contents);
  server = createServer((request, response) => {
    const body = pages.get(request.url!);
    response
      .writeHead(body === undefined ? 404 : 200, {
        'content-type': request.url!.endsWith('.js')
          ? 'text/javascript'
          : request.url === '/'
            ? 'text/html'
            : 'application/octet-stream',
      })
      .end(body);
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  browser = await chromium.launch(config.use!.launchOptions!);
  page = await browser.newPage();
  await page.goto(`http://127.0.0.1:${(server.address() as AddressInfo).port}/`);
});

afterAll(async () => {
  await browser?.close();
  server?.close();
});

/** Runs in the page; gives what can be sent back. */
const load = (path: string) =>
  page.evaluate(async (address) => {
    try {
      const scene = await (globalThis as unknown as { loadGltf: typeof loadGltf }).loadGltf(address);
      return {
        instances: scene.instances.length,
        warnings: scene.warnings,
        images: scene.images.map(({ width, height, data }) => [width, height, ...data]),
      };
    } catch (error) {
      return { code: (error as { code?: string }).code, message: (error as Error).message };
    }
  }, path);

test("a document, its buffer and its image, by relative addresses and the browser's own fetch", async () => {
  // Every alpha from nothing to all, with colours that a canvas would lose below it.
  const codes = Uint8Array.of(200, 40, 90, 0, 10, 20, 30, 1, 255, 128, 7, 128, 9, 99, 199, 255);
  pages
    .set('/m/a.gltf', textured())
    .set('/m/triangle.bin', triangle().binary)
    .set(
      '/m/image.png',
      await sharp(codes, { raw: { width: 2, height: 2, channels: 4 } })
        .png()
        .toBuffer(),
    );
  expect(await load('m/a.gltf')).toEqual({ instances: 1, warnings: [], images: [[2, 2, ...codes]] });
});

test('colour profiles do not count', async () => {
  const image = await sharp(Uint8Array.of(200, 40, 90), { raw: { width: 1, height: 1, channels: 3 } })
    .withIccProfile('p3')
    .png()
    .toBuffer();
  const codes = await sharp(image, { ignoreIcc: true }).raw().toBuffer();
  pages.set('/m/image.png', image);
  expect(await load('m/a.gltf')).toEqual({
    instances: 1,
    warnings: [],
    images: [[1, 1, ...codes.subarray(0, 3), 255]],
  });
});

test('errors are typed there too', async () => {
  pages.set('/m/short.glb', glb(triangle().json, new Uint8Array(8)));
  expect((await load('m/short.glb')).code).toBe('gltf/truncated');
  expect(await load('m/none.glb')).toEqual({
    code: 'gltf/missing-resource',
    message: expect.stringMatching(/none\.glb.*404/),
  });
});

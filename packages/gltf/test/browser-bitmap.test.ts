// Bitmaps go to the GPU as the browser has them; their pixels are not read before.
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { fileURLToPath } from 'node:url';
import { chromium, type Browser, type Page } from 'playwright';
import { build } from 'esbuild';
import sharp from 'sharp';
import { afterAll, beforeAll, expect, test } from 'vitest';
import config from '../../../playwright.config';
import type { decodeImageInBrowser } from '../src/index';

let server: Server, browser: Browser, page: Page;
const here = (path: string) => JSON.stringify(fileURLToPath(new URL(path, import.meta.url)));

beforeAll(async () => {
  const { outputFiles } = await build({
    stdin: {
      contents: `export { decodeImageInBrowser } from ${here('../src/index.ts')};
        import { uploadTextures } from ${here('../../renderer/src/materials/texture-upload.ts')};
        import { planTextures } from ${here('../../renderer/src/materials/textures.ts')};
        import { GpuMemory } from ${here('../../renderer/src/storage/buffers.ts')};
        export { uploadTextures, planTextures, GpuMemory };`,
      resolveDir: fileURLToPath(new URL('.', import.meta.url)),
    },
    bundle: true,
    write: false,
    format: 'iife',
    globalName: 'entry',
    conditions: ['@glanz/source'],
  });
  server = createServer((request, response) => {
    response
      .writeHead(200, { 'content-type': request.url === '/entry.js' ? 'text/javascript' : 'text/html' })
      .end(request.url === '/entry.js' ? outputFiles[0]!.contents : '<!doctype html><script src="entry.js"></script>');
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

interface Entry {
  readonly decodeImageInBrowser: typeof decodeImageInBrowser;
  readonly planTextures: (
    scene: unknown,
    used: number[],
    slots: number,
    limits: object,
  ) => { readonly arrays: readonly unknown[] };
  readonly uploadTextures: (
    device: GPUDevice,
    memory: unknown,
    scene: unknown,
    plan: unknown,
  ) => { readonly textures: GPUTexture[] };
  readonly GpuMemory: new (device: GPUDevice) => unknown;
}

/**
 * Decodes in the page; gives the codes that reach the GPU, those that `data` has, and whether `data` was read for the
 * upload.
 */
const decode = (file: Uint8Array, type: string, size: number, colorSpace: string) =>
  page.evaluate(
    async ([bytes, mime, edge, space]) => {
      const {
        decodeImageInBrowser: decodeImage,
        planTextures,
        uploadTextures,
        GpuMemory,
      } = (globalThis as unknown as { entry: Entry }).entry;
      const image = await decodeImage(Uint8Array.from(bytes as number[]), mime as string);
      const lazy = () => typeof Object.getOwnPropertyDescriptor(image, 'data')!.get === 'function';
      const device = await (await navigator.gpu.requestAdapter())!.requestDevice();
      // Copying out of a texture wants a usage that scenes have no need of.
      const create = device.createTexture.bind(device);
      device.createTexture = (descriptor) =>
        create({ ...descriptor, usage: descriptor.usage | GPUTextureUsage.COPY_SRC });
      const scene = { images: [image], textures: [{ image: 0, color_space: space }] };
      const { textures } = uploadTextures(
        device,
        new GpuMemory(device),
        scene,
        planTextures(scene, [0], 8, device.limits),
      );
      const before = lazy();
      const width = edge as number;
      const buffer = device.createBuffer({
        size: 256 * width,
        usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ,
      });
      const encoder = device.createCommandEncoder();
      encoder.copyTextureToBuffer({ texture: textures[0]! }, { buffer, bytesPerRow: 256 }, [width, width]);
      device.queue.submit([encoder.finish()]);
      await buffer.mapAsync(GPUMapMode.READ);
      const rows = new Uint8Array(buffer.getMappedRange());
      const uploaded = Array.from({ length: width }, (_, y) => [...rows.subarray(256 * y, 256 * y + 4 * width)]).flat();
      device.destroy();
      return { lazy: before, uploaded, data: [...image.data], after: lazy() };
    },
    [[...file], type, size, colorSpace] as const,
  );

// All codes, and colours that are lost where they are multiplied by alpha.
const SIZE = 32;
const codes = Uint8Array.from({ length: 4 * SIZE * SIZE }, (_, i) =>
  i % 4 === 3 ? (i >> 2) % 256 : (i * 37 + (i >> 5)) % 256,
);
const opaque = Uint8Array.from({ length: 3 * SIZE * SIZE }, (_, i) => (i * 89 + (i >> 4)) % 256);
const raw = (data: Uint8Array, channels: 3 | 4) => sharp(data, { raw: { width: SIZE, height: SIZE, channels } });
const withAlpha = (data: Uint8Array) =>
  Array.from({ length: 4 * SIZE * SIZE }, (_, i) => (i % 4 === 3 ? 255 : data[3 * (i >> 2) + (i % 4)]!));

test.each(['srgb', 'linear'])('a transparent PNG arrives in a %s texture as it is in the file', async (space) => {
  const { lazy, uploaded, data, after } = await decode(await raw(codes, 4).png().toBuffer(), 'image/png', SIZE, space);
  expect(uploaded).toEqual([...codes]);
  expect(data).toEqual([...codes]);
  expect([lazy, after]).toEqual([true, false]);
});

test.each([
  ['a profile', 'p3'],
  ['no profile', undefined],
] as const)('an opaque PNG with %s too', async (_, profile) => {
  const image = raw(opaque, 3);
  const file = await (profile ? image.withIccProfile(profile) : image).png().toBuffer();
  const truth = await sharp(file, { ignoreIcc: true }).raw().toBuffer();
  const { uploaded, data } = await decode(file, 'image/png', SIZE, 'srgb');
  expect(uploaded).toEqual(withAlpha(truth));
  expect(data).toEqual(withAlpha(truth));
});

test('neither the profile nor the orientation of a JPEG counts', async () => {
  const smooth = Uint8Array.from({ length: 3 * SIZE * SIZE }, (_, i) => {
    const p = Math.floor(i / 3);
    return [8 * (p % SIZE), 8 * Math.floor(p / SIZE), 90][i % 3]!;
  });
  const oriented = await raw(smooth, 3)
    .withIccProfile('p3')
    .withMetadata({ orientation: 6 })
    .jpeg({ quality: 95, chromaSubsampling: '4:4:4' })
    .toBuffer();
  expect((await sharp(oriented).metadata()).orientation).toBe(6);
  const truth = await sharp(oriented, { ignoreIcc: true }).raw().toBuffer();
  const { uploaded } = await decode(oriented, 'image/jpeg', SIZE, 'srgb');
  // Two decoders of JPEG may round differently.
  const off = withAlpha(truth).map((code, i) => Math.abs(code - uploaded[i]!));
  expect(Math.max(...off)).toBeLessThanOrEqual(2);
});

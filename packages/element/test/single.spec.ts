import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { animatedQuads, hdr, photograph, quads, usdSquare, usdz } from '@glanz/browser';
import { expect, test, type Page } from '@playwright/test';
import { buildSingleFile } from '../scripts/single-file.mjs';
import { dracoModel, ktx2Model } from './packed';

// Plain HTML on one origin, the file on another, as from a content delivery network.

const folder = mkdtempSync(join(tmpdir(), 'glanz-single-'));
const asked: string[] = [];
const servers: Server[] = [];
let network = '';
let site = '';
let policy: string | undefined;
let draco: Buffer = Buffer.alloc(0);
const ktx2 = ktx2Model();

const model = quads([{ name: 'red', colour: [0.9, 0.02, 0.02] }]);
const OBJ = 'v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n';

async function listen(
  answer: (path: string) => { readonly body: string | Uint8Array; readonly type: string } | undefined,
  headers: () => Record<string, string>,
): Promise<number> {
  const server = createServer((request, response) => {
    const found = answer(new URL(request.url ?? '/', 'http://localhost').pathname);
    response.writeHead(found ? 200 : 404, { 'content-type': found?.type ?? 'text/plain', ...headers() });
    response.end(found?.body);
  });
  servers.push(server);
  await new Promise<void>((resolve) => server.listen(0, resolve));
  return (server.address() as AddressInfo).port;
}

test.beforeAll(async () => {
  draco = await dracoModel();
  await buildSingleFile(fileURLToPath(new URL('..', import.meta.url)), folder);
  const files = await listen(
    (path) => {
      asked.push(path);
      return /^\/[\w.-]+\.js$/.test(path)
        ? { body: readFileSync(join(folder, path)), type: 'text/javascript' }
        : undefined;
    },
    () => ({ 'access-control-allow-origin': '*' }),
  );
  network = `http://127.0.0.1:${files}`;
  const pages = await listen(
    (path) => {
      if (path.endsWith('/draco.glb')) return { body: draco, type: 'model/gltf-binary' };
      if (path.endsWith('/ktx2.glb')) return { body: ktx2, type: 'model/gltf-binary' };
      if (path.endsWith('/animated.glb')) return { body: animatedQuads, type: 'model/gltf-binary' };
      if (path.endsWith('.glb')) return { body: model, type: 'model/gltf-binary' };
      if (path.endsWith('.obj')) return { body: OBJ, type: 'text/plain' };
      if (path.endsWith('.usdz')) return { body: usdz(usdSquare([0.9, 0.02, 0.02])), type: 'model/vnd.usdz+zip' };
      if (path.endsWith('.hdr')) return { body: hdr([128, 0, 0, 129]), type: 'image/vnd.radiance' };
      const html = (rest: string) =>
        `<!doctype html>\n<html lang="en"><link rel="icon" href="data:,"><title>Page</title>\n<script type="module" src="${network}/glanz-viewer.min.js"></script>\n${rest}\n`;
      const attributes =
        'alt="A card" samples="6" max-depth="3" pixel-ratio="0.25" camera-orbit="0deg 90deg 3m" field-of-view="35deg"';
      if (path === '/')
        return { body: html(`<glanz-viewer src="red.glb" ${attributes}></glanz-viewer>`), type: 'text/html' };
      if (path === '/other')
        return {
          body: html(`<glanz-viewer src="card.obj" environment-image="red.hdr" ${attributes}></glanz-viewer>`),
          type: 'text/html',
        };
      if (path === '/usd')
        return { body: html(`<glanz-viewer src="red.usdz" ${attributes}></glanz-viewer>`), type: 'text/html' };
      if (path === '/animated')
        return {
          body: html(`<glanz-viewer src="animated.glb" shadow-intensity="1" ${attributes}></glanz-viewer>`),
          type: 'text/html',
        };
      if (path === '/draco' || path === '/ktx2')
        return {
          body: html(`<glanz-viewer src="${path.slice(1)}.glb" ${attributes}></glanz-viewer>`),
          type: 'text/html',
        };
      return undefined;
    },
    () => (policy === undefined ? {} : { 'content-security-policy': policy }),
  );
  site = `http://localhost:${pages}`;
});
test.afterAll(() => {
  for (const server of servers) server.close();
  rmSync(folder, { recursive: true, force: true });
});
test.beforeEach(() => {
  asked.length = 0;
  policy = undefined;
});
test.use({ viewport: { width: 640, height: 480 } });

const done = (page: Page) =>
  expect.poll(() => page.evaluate(() => document.querySelector('glanz-viewer')?.viewer?.state)).toBe('done');
const middle = async (page: Page) => (await photograph(page.locator('glanz-viewer'))).cells[4]!;

/** Opens a page; what it complains about and the workers that it starts. */
async function open(page: Page, path: string): Promise<{ readonly errors: string[]; readonly workers: string[] }> {
  const errors: string[] = [];
  const workers: string[] = [];
  page.on('pageerror', (error) => errors.push(error.message));
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  page.on('worker', (worker) => workers.push(worker.url()));
  await page.goto(site + path);
  await done(page);
  return { errors, workers };
}

/** Files that were fetched, each once. */
const loaded = () => [...new Set(asked)].sort();

test('two lines of HTML show a model with a file of another origin, whose workers run', async ({ page }) => {
  const { errors, workers } = await open(page, '/');
  const [r, g] = await middle(page);
  expect(r).toBeGreaterThan(2 * g);
  expect(errors).toEqual([]);
  expect(workers.length).toBeGreaterThan(0);
  for (const address of workers) expect(address).toMatch(/^blob:http:\/\/localhost/);
  // A plain .glb takes the one file and nothing else.
  expect(loaded()).toEqual(['/glanz-viewer.min.js']);
});

test('where the policy forbids workers of a Blob, the model is read and its hierarchies built on the main thread', async ({
  page,
}) => {
  policy = `default-src 'none'; script-src ${network}; style-src 'self'; img-src 'self' data:; connect-src 'self'; worker-src 'self'`;
  const { errors, workers } = await open(page, '/');
  const [r, g] = await middle(page);
  expect(r).toBeGreaterThan(2 * g);
  expect(workers).toEqual([]);
  // The browser reports what the policy refused, and nothing else went wrong.
  expect(errors.filter((text) => !/worker-src|Content Security Policy/i.test(text))).toEqual([]);
  expect(
    await page.evaluate(
      () => document.querySelector('glanz-viewer')?.shadowRoot?.querySelector<HTMLElement>('[role=alert]')?.hidden,
    ),
  ).toBe(true);
});

test('other formats, environments and what saves images come from files beside it', async ({ page }) => {
  const { errors } = await open(page, '/other');
  const [r, g] = await middle(page);
  expect(r).toBeGreaterThan(2 * g);
  expect(errors).toEqual([]);
  const files = ['/glanz-viewer.environment.min.js', '/glanz-viewer.formats.min.js', '/glanz-viewer.min.js'];
  expect(loaded()).toEqual(files);
  const blob = await page.evaluate(async () => {
    const { type, size } = await document.querySelector('glanz-viewer')!.toBlob();
    return { type, size };
  });
  expect(blob).toEqual({ type: 'image/png', size: expect.any(Number) });
  expect(blob.size).toBeGreaterThan(1000);
  expect(loaded()).toEqual([...files, '/glanz-viewer.save.min.js'].sort());
});

test('the reader of USD comes from a file beside it, for a .usdz alone', async ({ page }) => {
  const { errors } = await open(page, '/usd');
  const [r, g] = await middle(page);
  expect(r).toBeGreaterThan(2 * g);
  expect(errors).toEqual([]);
  expect(loaded()).toEqual(['/glanz-viewer.formats.min.js', '/glanz-viewer.min.js', '/glanz-viewer.usd.min.js']);
});

for (const [kind, files] of [
  ['draco', ['draco']],
  ['ktx2', ['basis', 'ktx2']],
] as const) {
  test(`a model in ${kind} is shown by itself; its decoder comes from beside the file`, async ({ page }) => {
    const { errors } = await open(page, `/${kind}`);
    const [r, g] = await middle(page);
    expect(r).toBeGreaterThan(2 * g);
    expect(errors).toEqual([]);
    expect(loaded()).toEqual([...files.map((name) => `/glanz-viewer.${name}.min.js`), '/glanz-viewer.min.js'].sort());
  });
}

test('animations and a ground come from beside the file', async ({ page }) => {
  const { errors } = await open(page, '/animated');
  expect(loaded()).toEqual(['/glanz-viewer.min.js', '/glanz-viewer.stage.min.js']);
  await page.evaluate(() => void (document.querySelector('glanz-viewer')!.currentTime = 0.2));
  const places = () =>
    page.evaluate(() =>
      document.querySelector('glanz-viewer')!.viewer!.scene!.instances.map(({ transform }) => transform[12]!),
    );
  await expect.poll(async () => (await places()).map((x) => Math.round(10 * x))).toEqual([12, -12, 0]);
  expect(errors).toEqual([]);
  expect(loaded()).toContain('/glanz-viewer.animation.min.js');
});

test('what filters moving frames comes from beside the file, with the second movement', async ({ page }) => {
  const { errors } = await open(page, '/');
  const filtered = await page.evaluate(async () => {
    const element = document.querySelector('glanz-viewer')!;
    const viewer = element.viewer!;
    viewer.previewMode = 'filtered';
    let found = false;
    viewer.on('frame', ({ preview, denoised }) => void (found ||= preview && denoised));
    const end = performance.now() + 60_000;
    for (let i = 0; !found && performance.now() < end; i++) {
      viewer.setOrbit({ theta: 0.1 + 0.01 * (i % 20) }, { immediate: true });
      await new Promise((resolve) => setTimeout(resolve, 30));
    }
    return found;
  });
  expect(filtered).toBe(true);
  expect(errors).toEqual([]);
  expect(loaded()).toContain('/glanz-viewer.realtime.min.js');
});

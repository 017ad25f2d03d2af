import { createHash } from 'node:crypto';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import { chromium, type Browser } from 'playwright';
import { afterAll, beforeAll, expect, test } from 'vitest';
import config from '../../../../playwright.config';
import { buildBlas } from '../../src/blas';
import type { BvhWorkers } from '../../src/worker/workers';
import { sphere } from '../shapes';

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));
/** More than 200,000 triangles: enough for two workers. */
const RINGS = 480;

let server: Server, browser: Browser, origin: string, expected: string;

beforeAll(async () => {
  const bundle = async (source: { readonly contents: string } | string) =>
    (
      await build({
        ...(typeof source === 'string' ? { entryPoints: [source] } : { stdin: { ...source, resolveDir: here('.') } }),
        bundle: true,
        write: false,
        format: 'esm',
        conditions: ['@glanz/source'],
      })
    ).outputFiles[0]!.contents;
  const files = new Map<string, string | Uint8Array>([
    [
      '/entry.js',
      await bundle({
        contents: `import { BvhWorkers } from ${JSON.stringify(here('../../src/worker/workers.ts'))}; import { sphere } from ${JSON.stringify(here('../shapes.ts'))}; Object.assign(globalThis, { BvhWorkers, sphere });`,
      }),
    ],
    ['/worker.js', await bundle(here('../../src/worker/worker.ts'))],
  ]);
  const page = '<!doctype html><script type="module" src="/entry.js"></script>';
  server = createServer((request, response) => {
    const path = new URL(request.url!, 'http://x').pathname;
    const body = path === '/isolated' || path === '/plain' ? page : files.get(path);
    response
      .writeHead(body === undefined ? 404 : 200, {
        'content-type': path.endsWith('.js') ? 'text/javascript' : 'text/html',
        'content-security-policy': "default-src 'none'; script-src 'self'; worker-src 'self'",
        // What an isolated page loads has to allow it, its workers too.
        ...(path === '/plain'
          ? {}
          : {
              'cross-origin-opener-policy': 'same-origin',
              'cross-origin-embedder-policy': 'require-corp',
              'cross-origin-resource-policy': 'same-origin',
            }),
      })
      .end(body);
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  origin = `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
  browser = await chromium.launch(config.use!.launchOptions!);
  const { nodes, triangleIndices } = buildBlas(sphere(RINGS));
  expected = createHash('sha256').update(nodes).update(triangleIndices).digest('hex');
});

afterAll(async () => {
  await browser?.close();
  server?.close();
});

/** Builds a mesh twice in a page: the trees' digests, and how many messages of which kinds the workers were sent. */
async function builtIn(path: string, { threads, together }: { readonly threads: number; readonly together?: boolean }) {
  const page = await browser.newPage();
  try {
    await page.addInitScript(
      (count) => Object.defineProperty(navigator, 'hardwareConcurrency', { get: () => count }),
      threads,
    );
    await page.goto(`${origin}${path}`);
    await page.waitForFunction(() => 'BvhWorkers' in globalThis);
    return await page.evaluate(
      async ({ rings, given }) => {
        const { BvhWorkers: Pool, sphere: make } = globalThis as unknown as {
          BvhWorkers: typeof BvhWorkers;
          sphere: typeof sphere;
        };
        const sent: Record<string, number> = {};
        let ready = 0;
        const createWorker = () => {
          const worker = new Worker('/worker.js', { type: 'module' });
          const post = worker.postMessage.bind(worker) as Worker['postMessage'];
          worker.postMessage = (message: { kind: string }, transfer?: Transferable[] | StructuredSerializeOptions) => {
            post(message, transfer as Transferable[]);
            sent[message.kind] = (sent[message.kind] ?? 0) + 1;
          };
          worker.addEventListener(
            'message',
            ({ data }) => void (ready += Number((data as { kind: string }).kind === 'ready')),
          );
          return worker;
        };
        const workers = await Pool.create({
          count: 2,
          createWorker,
          ...(given === undefined ? {} : { together: given }),
        });
        // Both have to be there.
        while (ready < 2 && workers.fallback === undefined) await new Promise((resolve) => setTimeout(resolve, 5));
        const mesh = make(rings);
        const digests: string[] = [];
        for (let i = 0; i < 2; i++) {
          const { nodes, triangleIndices } = await workers.buildBlas(mesh);
          const all = new Uint8Array(nodes.byteLength + triangleIndices.byteLength);
          all.set(new Uint8Array(nodes.buffer, nodes.byteOffset, nodes.byteLength));
          all.set(
            new Uint8Array(triangleIndices.buffer, triangleIndices.byteOffset, triangleIndices.byteLength),
            nodes.byteLength,
          );
          digests.push(
            [...new Uint8Array(await crypto.subtle.digest('SHA-256', all))]
              .map((byte) => byte.toString(16).padStart(2, '0'))
              .join(''),
          );
          // The second worker of a build reports a moment after the first.
          await new Promise((resolve) => setTimeout(resolve, 100));
        }
        const { fallback } = workers;
        workers.destroy();
        return { isolated: globalThis.crossOriginIsolated, fallback, digests, sent, kept: mesh.positions.length };
      },
      { rings: RINGS, given: together },
    );
  } finally {
    await page.close();
  }
}

test('an isolated page: two workers build one mesh together, the same tree', async () => {
  const { isolated, fallback, digests, sent, kept } = await builtIn('/isolated', { threads: 4 });
  expect(isolated).toBe(true);
  expect(fallback).toBeUndefined();
  expect(digests).toEqual([expected, expected]);
  // One message to each of two workers for the first build at least.
  expect(sent['together']).toBeGreaterThanOrEqual(2);
  expect(kept).toBe(sphere(RINGS).positions.length);
});

test('a page that is not isolated: one worker builds it, whatever was asked for, the same tree', async () => {
  for (const together of [undefined, true]) {
    const { isolated, fallback, digests, sent } = await builtIn('/plain', {
      threads: 4,
      ...(together === undefined ? {} : { together }),
    });
    expect(isolated).toBe(false);
    expect(fallback).toBeUndefined();
    expect(digests).toEqual([expected, expected]);
    expect(sent).toEqual({ build: 2 });
  }
});

test('a machine without idle threads: one worker, unless two are asked for', async () => {
  const alone = await builtIn('/isolated', { threads: 2 });
  expect(alone.sent).toEqual({ build: 2 });
  expect(alone.digests).toEqual([expected, expected]);
  const { sent, digests } = await builtIn('/isolated', { threads: 2, together: true });
  expect(sent['together']).toBeGreaterThanOrEqual(2);
  expect(digests).toEqual([expected, expected]);
});

import { readFileSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import { createRequire } from 'node:module';
import type { AddressInfo } from 'node:net';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import draco3d from 'draco3dgltf';
import { build } from 'esbuild';
import { chromium, type Browser } from 'playwright';
import { afterAll, beforeAll, expect, test } from 'vitest';
import config from '../../../playwright.config';
import type { loadGltf as LoadGltf } from '../src/index';
import { loadGltf, packagedDecoders } from '../src/node';
import type { DracoWorkers as Helpers, GltfWorker as Loader } from '../src/worker/load';
import { glb } from './build';

/** What is used of the encoder. */
interface Encoder {
  readonly [name: string]: unknown;
  readonly Mesh: new () => object;
  readonly MeshBuilder: new () => {
    AddFacesToMesh(mesh: object, faces: number, indices: Uint32Array): void;
    AddFloatAttributeToMesh(mesh: object, type: unknown, vertices: number, size: number, values: Float32Array): number;
  };
  readonly Encoder: new () => {
    SetSpeedOptions(encode: number, decode: number): void;
    SetAttributeQuantization(type: unknown, bits: number): void;
    EncodeMeshToDracoBuffer(mesh: object, array: object): number;
  };
  readonly DracoInt8Array: new () => { GetValue(index: number): number };
}

/** A wavy square of `side`² × 2 triangles. */
function waves(side: number, phase: number): { positions: Float32Array; indices: Uint32Array } {
  const positions = new Float32Array(3 * (side + 1) ** 2),
    indices: number[] = [];
  for (let y = 0; y <= side; y++)
    for (let x = 0; x <= side; x++)
      positions.set(
        [x / side, Math.sin(9 * (x / side) + phase) * Math.cos((7 * y) / side), y / side],
        3 * (y * (side + 1) + x),
      );
  for (let y = 0; y < side; y++)
    for (let x = 0; x < side; x++) {
      const a = y * (side + 1) + x,
        b = a + side + 1;
      indices.push(a, b, a + 1, a + 1, b, b + 1);
    }
  return { positions, indices: Uint32Array.from(indices) };
}

/** Draco-compressed meshes, a node each, in one document; `spoil` changes packed bytes. */
async function packedDocument(
  sides: readonly number[],
  spoil: (bytes: Uint8Array, index: number) => void = () => undefined,
): Promise<Uint8Array> {
  const module = (await draco3d.createEncoderModule()) as Encoder;
  const parts: Uint8Array[] = [],
    accessors: object[] = [],
    bufferViews: object[] = [],
    meshes: object[] = [];
  let at = 0;
  for (const [index, side] of sides.entries()) {
    const { positions, indices } = waves(side, index),
      vertices = positions.length / 3;
    const mesh = new module.Mesh(),
      builder = new module.MeshBuilder(),
      encoder = new module.Encoder(),
      array = new module.DracoInt8Array();
    builder.AddFacesToMesh(mesh, indices.length / 3, indices);
    const id = builder.AddFloatAttributeToMesh(mesh, module['POSITION'], vertices, 3, positions);
    encoder.SetSpeedOptions(5, 5);
    encoder.SetAttributeQuantization(module['POSITION'], 14);
    const length = encoder.EncodeMeshToDracoBuffer(mesh, array);
    const bytes = Uint8Array.from({ length: Math.ceil(length / 4) * 4 }, (_, i) =>
      i < length ? array.GetValue(i) : 0,
    );
    spoil(bytes, index);
    accessors.push(
      { componentType: 5126, count: vertices, type: 'VEC3', min: [0, -1, 0], max: [1, 1, 1] },
      { componentType: 5125, count: indices.length, type: 'SCALAR' },
    );
    bufferViews.push({ buffer: 0, byteOffset: at, byteLength: length });
    meshes.push({
      primitives: [
        {
          attributes: { POSITION: 2 * index },
          indices: 2 * index + 1,
          extensions: { KHR_draco_mesh_compression: { bufferView: index, attributes: { POSITION: id } } },
        },
      ],
    });
    parts.push(bytes);
    at += bytes.length;
  }
  const binary = new Uint8Array(at);
  let to = 0;
  for (const part of parts) {
    binary.set(part, to);
    to += part.length;
  }
  const names = ['KHR_draco_mesh_compression'];
  return glb(
    {
      asset: { version: '2.0' },
      extensionsUsed: names,
      extensionsRequired: names,
      scenes: [{ nodes: sides.map((_, i) => i) }],
      nodes: sides.map((_, mesh) => ({ mesh })),
      meshes,
      accessors,
      bufferViews,
      buffers: [{ byteLength: at }],
    },
    binary,
  );
}

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));
const SIDES = [60, 90, 40, 120, 75];
let server: Server, browser: Browser, origin: string;
const files = new Map<string, string | Uint8Array>();

beforeAll(async () => {
  const bundle = async (contents: string) =>
    (
      await build({
        stdin: { contents, resolveDir: here('.') },
        bundle: true,
        write: false,
        format: 'esm',
        conditions: ['@glanz/source'],
        external: ['fs', 'path', 'crypto'],
        define: { 'process.versions': '{}' },
        logLevel: 'error',
      })
    ).outputFiles[0]!.contents;
  const draco = `let module; const draco = () => (module ??= import('draco3dgltf/draco_decoder_gltf_nodejs.js').then(({ default: create }) => create({ locateFile: () => '/draco.wasm' })));`;
  files.set('/', '<!doctype html><script type="module" src="/entry.js"></script>');
  files.set(
    '/entry.js',
    await bundle(
      `import { loadGltf } from ${JSON.stringify(here('../src/index.ts'))}; import { DracoWorkers, GltfWorker } from ${JSON.stringify(here('../src/worker/load.ts'))}; ${draco} Object.assign(globalThis, { loadGltf, DracoWorkers, GltfWorker, draco });`,
    ),
  );
  files.set(
    '/worker.js',
    await bundle(`import { serveGltf } from ${JSON.stringify(here('../src/worker/worker.ts'))}; ${draco}
    // As on a machine of so many threads; helper workers that are started are counted.
    const threads = new URLSearchParams(location.search).get('threads');
    if (threads) Object.defineProperty(navigator, 'hardwareConcurrency', { get: () => Number(threads) });
    const Real = Worker, channel = new BroadcastChannel('helpers');
    globalThis.Worker = class extends Real { constructor(...given) { super(...given); channel.postMessage('started'); } };
    serveGltf({ decoders: { draco } });`),
  );
  files.set(
    '/draco.wasm',
    readFileSync(join(dirname(createRequire(import.meta.url).resolve('draco3dgltf')), 'draco_decoder_gltf.wasm')),
  );
  files.set('/board.glb', await packedDocument(SIDES));
  // The header of one of them is none.
  files.set(
    '/broken.glb',
    await packedDocument(SIDES, (bytes, index) => void (index === 3 && bytes.fill(0x55, 0, 11))),
  );
  server = createServer((request, response) => {
    const path = new URL(request.url!, 'http://x').pathname;
    const body = files.get(path);
    response
      .writeHead(body === undefined ? 404 : 200, {
        'content-type': path.endsWith('.js')
          ? 'text/javascript'
          : path === '/'
            ? 'text/html'
            : path.endsWith('.wasm')
              ? 'application/wasm'
              : 'application/octet-stream',
      })
      .end(body);
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  origin = `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
  browser = await chromium.launch(config.use!.launchOptions!);
});

afterAll(async () => {
  await browser?.close();
  server?.close();
});

interface Page {
  readonly loadGltf: typeof LoadGltf;
  readonly DracoWorkers: typeof Helpers;
  readonly GltfWorker: typeof Loader;
  readonly draco: () => Promise<unknown>;
}

async function withPage<T>(
  threads: number,
  run: (page: Awaited<ReturnType<Browser['newPage']>>) => Promise<T>,
): Promise<T> {
  const page = await browser.newPage();
  try {
    await page.addInitScript(
      (count) => Object.defineProperty(navigator, 'hardwareConcurrency', { get: () => count }),
      threads,
    );
    await page.goto(`${origin}/`);
    await page.waitForFunction(() => 'DracoWorkers' in globalThis);
    return await run(page);
  } finally {
    await page.close();
  }
}

/** A load on the page's own thread: its meshes, or its error, and what the helpers were asked and did. */
const loadBy = (path: string, createWorker: 'helper' | 'none' | 'missing') =>
  withPage(4, (page) =>
    page.evaluate(
      async ({ address, kind }) => {
        const { loadGltf: load, DracoWorkers: Pool, draco } = globalThis as unknown as Page;
        let asked = 0,
          unpacked = 0,
          started = 0,
          here = 0;
        const dracoWorkers = new Pool({
          createWorker: () => {
            started++;
            const worker = new Worker(kind === 'missing' ? '/none.js' : '/worker.js', { type: 'module' });
            const post = worker.postMessage.bind(worker) as (message: unknown, transfer: Transferable[]) => void;
            worker.postMessage = (
              message: { kind: string },
              transfer?: Transferable[] | StructuredSerializeOptions,
            ) => {
              asked += Number(message.kind === 'draco');
              post(message, transfer as Transferable[]);
            };
            worker.addEventListener(
              'message',
              ({ data }) => void (unpacked += Number((data as { primitive?: object }).primitive !== undefined)),
            );
            return worker;
          },
        });
        // The page's own decoder, counted.
        const counted = async () => {
          const module = (await draco()) as { Decoder: new () => object };
          return new Proxy(module, {
            get: (target, name) => {
              if (name === 'Decoder') here++;
              return (target as unknown as Record<string | symbol, unknown>)[name];
            },
          });
        };
        try {
          const scene = await load(address, {
            decoders: { draco: counted, ...(kind === 'none' ? {} : { dracoWorkers }) },
          });
          return {
            meshes: scene.meshes.map(({ positions, indices }) => [[...positions], [...indices]]),
            asked,
            unpacked,
            started,
            here,
          };
        } catch (error) {
          return { error: (error as Error).message, code: (error as { code?: string }).code, asked, unpacked, here };
        } finally {
          dracoWorkers.destroy();
        }
      },
      { address: path, kind: createWorker },
    ),
  );

/** The same by the package for Node, one mesh after the other. */
async function expected() {
  const scene = await loadGltf(files.get('/board.glb') as Uint8Array<ArrayBuffer>, { decoders: packagedDecoders() });
  return scene.meshes.map(({ positions, indices }) => [[...positions], [...indices]]);
}

test('workers unpack all meshes, several of them at a time, to the same numbers', async () => {
  const { meshes, asked, unpacked, started, here: own } = await loadBy('/board.glb', 'helper');
  expect(meshes).toEqual(await expected());
  expect(meshes!.map(([, indices]) => indices!.length)).toEqual(SIDES.map((side) => 6 * side * side));
  expect([asked, unpacked, started, own]).toEqual([5, 5, 4, 0]);
});

test('a worker that cannot be started only costs time', async () => {
  const { meshes, here: own } = await loadBy('/board.glb', 'missing');
  expect(meshes).toEqual(await expected());
  expect(own).toBe(5);
});

test('a broken mesh is reported as without workers', async () => {
  const [by, alone] = [await loadBy('/broken.glb', 'helper'), await loadBy('/broken.glb', 'none')];
  expect([by.error, by.code]).toEqual([alone.error, alone.code]);
  expect(by.error === undefined ? by.meshes : by.code).toEqual(
    alone.error === undefined ? alone.meshes : 'gltf/malformed',
  );
  expect([by.asked, by.unpacked]).toEqual([5, 4]);
});

test("a worker file of one's own has helpers by itself, where there are threads", async () => {
  const meshesHere = await expected();
  for (const [threads, helpers] of [
    [2, 0],
    [4, 4],
  ] as const) {
    const { meshes, started } = await withPage(threads, (page) =>
      page.evaluate(async (count) => {
        const { GltfWorker: Own } = globalThis as unknown as Page;
        let started = 0;
        const channel = new BroadcastChannel('helpers');
        channel.onmessage = () => void started++;
        const worker = new Own({ createWorker: () => new Worker(`/worker.js?threads=${count}`, { type: 'module' }) });
        const scene = await worker.load('/board.glb');
        // Once more: helpers stay.
        await worker.load('/board.glb');
        // What was sent before comes before.
        await new Promise<void>((resolve) => {
          const last = new BroadcastChannel('helpers');
          channel.onmessage = ({ data }) => (data === 'last' ? resolve() : void started++);
          last.postMessage('last');
        });
        worker.destroy();
        return { meshes: scene.meshes.map(({ positions, indices }) => [[...positions], [...indices]]), started };
      }, threads),
    );
    expect(meshes).toEqual(meshesHere);
    expect(started).toBe(helpers);
  }
});

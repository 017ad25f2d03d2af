import { createReadStream, existsSync, readFileSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import type { AddressInfo } from 'node:net';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { build } from 'esbuild';
import { timed, type Benchmark, type Figure } from '../benchmark';
import { BenchError } from '../error';

/** Models beside the repository: large pictures, Draco, meshopt, many meshes, many triangles. */
const MODELS = ['DamagedHelmet', 'chess-board', 'pirate-meshopt', 'lamborghini', 'bunny-casual-effects'];

/** One load, as the page reports it. */
interface Load {
  /** Until there is a scene. */
  readonly ms: number;
  readonly triangles: number;
}

const geometricMean = (values: readonly number[]) => Math.exp(values.reduce((sum, value) => sum + Math.log(value), 0) / values.length);

const OURS = `
import { loadGltf } from '@glanz/gltf';
import { loadGltfInWorker } from '@glanz/gltf/workers';
const meshopt = async () => (await import('meshoptimizer/decoder')).MeshoptDecoder;
// Kept between loads, as three.js keeps its own.
let module;
const draco = () => (module ??= import('draco3dgltf/draco_decoder_gltf_nodejs.js').then(({ default: create }) => create({ locateFile: () => '/draco.wasm' })));
const count = (scene) => scene.instances.reduce((sum, { mesh }) => sum + scene.meshes[mesh].indices.length / 3, 0);
globalThis.loaders.glanz = async (url) => count(await loadGltf(url, { decoders: { meshopt, draco } }));
globalThis.loaders.worker = async (url) => count(await loadGltfInWorker(url, { createWorker: () => new Worker('/own-worker.js', { type: 'module' }) }));
`;
const WORKER = `
import { serveGltf } from '@glanz/gltf/worker';
serveGltf({ decoders: {
  meshopt: async () => (await import('meshoptimizer/decoder')).MeshoptDecoder,
  draco: async () => (await import('draco3dgltf/draco_decoder_gltf_nodejs.js')).default({ locateFile: () => '/draco.wasm' }),
} });
`;
const THREE = `
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { DRACOLoader } from 'three/examples/jsm/loaders/DRACOLoader.js';
import { MeshoptDecoder } from 'three/examples/jsm/libs/meshopt_decoder.module.js';
const draco = new DRACOLoader().setDecoderPath('/three-draco/');
globalThis.loaders.three = async (url) => {
  const loader = new GLTFLoader().setDRACOLoader(draco).setMeshoptDecoder(MeshoptDecoder);
  const { scene } = await loader.loadAsync(url);
  let triangles = 0;
  scene.traverse(({ isMesh, isInstancedMesh, count, geometry }) => { if (isMesh) triangles += ((geometry.index ?? geometry.attributes.position).count / 3) * (isInstancedMesh ? count : 1); });
  return triangles;
};
`;

/** Bundles with the sources of the workspace, for the page. */
async function bundle(contents: string, folder: string): Promise<Uint8Array> {
  const { outputFiles } = await build({ stdin: { contents, resolveDir: folder }, bundle: true, write: false, format: 'esm', minify: true, target: 'es2022', conditions: ['@glanz/source'], external: ['fs', 'path', 'crypto', 'node:*'], define: { 'process.versions': '{}' }, logLevel: 'error' });
  return outputFiles[0]!.contents;
}

/** Our loader beside three.js's GLTFLoader with its decoders, in Chromium: from an address to a scene. */
export const benchmark: Benchmark = {
  description: "glTF loading against three.js's GLTFLoader, in Chromium",
  async run({ log, quick }) {
    const assets = resolve('../shared/assets');
    if (!existsSync(join(assets, 'index.json'))) throw new BenchError('bench/assets', 'There are no test models in ../shared/assets beside the repository.');
    const index = JSON.parse(readFileSync(join(assets, 'index.json'), 'utf8')) as readonly { name: string; main: string }[];
    const models = MODELS.map((name) => ({ name, main: index.find((entry) => entry.name === name)?.main })).filter((model): model is { name: string; main: string } => model.main !== undefined);
    const folder = resolve('tools/bench'), gltf = resolve('packages/gltf');
    const require = createRequire(join(gltf, 'package.json')), requireThree = createRequire(join(folder, 'package.json'));
    const files = new Map<string, string | Uint8Array>([
      ['/', '<!doctype html><script>globalThis.loaders = {};</script><script type="module" src="/ours.js"></script><script type="module" src="/three.js"></script>'],
      ['/ours.js', await bundle(OURS, gltf)],
      ['/own-worker.js', await bundle(WORKER, gltf)],
      ['/three.js', await bundle(THREE, folder)],
      ['/draco.wasm', readFileSync(join(dirname(require.resolve('draco3dgltf')), 'draco_decoder_gltf.wasm'))],
    ]);
    const threeDraco = join(dirname(requireThree.resolve('three')), '../examples/jsm/libs/draco/gltf');
    for (const name of ['draco_decoder.js', 'draco_wasm_wrapper.js', 'draco_decoder.wasm']) if (existsSync(join(threeDraco, name))) files.set(`/three-draco/${name}`, readFileSync(join(threeDraco, name)));
    const server = createServer((request, response) => {
      const path = decodeURIComponent(new URL(request.url!, 'http://x').pathname);
      const body = files.get(path);
      const type = path.endsWith('.js') ? 'text/javascript' : path.endsWith('.wasm') ? 'application/wasm' : path === '/' ? 'text/html' : 'application/octet-stream';
      const file = join(assets, path.slice('/assets'.length));
      if (body !== undefined) response.writeHead(200, { 'content-type': type }).end(body);
      else if (path.startsWith('/assets/') && file.startsWith(assets) && existsSync(file)) {
        response.writeHead(200, { 'content-type': type, 'content-length': statSync(file).size, 'cache-control': 'no-store' });
        createReadStream(file).pipe(response);
      } else response.writeHead(404).end();
    });
    await new Promise<void>((done) => server.listen(0, '127.0.0.1', done));
    const { chromium } = await import('playwright');
    const { default: config } = (await import('../../../../playwright.config')) as { default: { use?: { launchOptions?: Parameters<typeof chromium.launch>[0] } } };
    const browser = await chromium.launch(config.use?.launchOptions ?? {});
    const runs = quick ? 2 : 7;
    const figures: Figure[] = [];
    const ratios = { main: [] as number[], worker: [] as number[] };
    try {
      const page = await browser.newPage();
      await page.goto(`http://127.0.0.1:${(server.address() as AddressInfo).port}/`);
      await page.waitForFunction(() => 'three' in (globalThis as unknown as { loaders: object }).loaders && 'glanz' in (globalThis as unknown as { loaders: object }).loaders);
      const load = (loader: string, url: string): Promise<Load> =>
        page.evaluate(async ([name, address]) => {
          const begun = performance.now();
          const triangles = await (globalThis as unknown as { loaders: Record<string, (url: string) => Promise<number>> }).loaders[name!]!(address!);
          return { ms: performance.now() - begun, triangles };
        }, [loader, url]);
      for (const { name, main } of models) {
        const url = `/assets/${main.split('/').map(encodeURIComponent).join('/')}`;
        const times = { glanz: [] as number[], worker: [] as number[], three: [] as number[] };
        // Taken in turns, so that a disturbance of the machine meets all alike.
        for (let i = -1; i < runs; i++) {
          const counts = new Set<number>();
          for (const loader of ['glanz', 'worker', 'three'] as const) {
            const { ms, triangles } = await load(loader, url);
            counts.add(triangles);
            if (i >= 0) times[loader].push(ms);
          }
          if (counts.size !== 1) throw new BenchError('bench/different', `${name}: the loaders find different numbers of triangles: ${[...counts].join(', ')}.`);
        }
        const main_ = times.three.map((t, i) => t / times.glanz[i]!), worker = times.three.map((t, i) => t / times.worker[i]!);
        figures.push(timed(`${name}: loadGltf`, 'ms', times.glanz), timed(`${name}: loadGltfInWorker`, 'ms', times.worker), timed(`${name}: three.js`, 'ms', times.three), timed(`${name}: three.js over loadGltf`, '1', main_), timed(`${name}: three.js over loadGltfInWorker`, '1', worker));
        const middle = (list: number[]) => [...list].sort((a, b) => a - b)[list.length >> 1]!;
        ratios.main.push(middle(main_));
        ratios.worker.push(middle(worker));
        log(`${name}: ${middle(times.glanz).toFixed(0)} ms, in a worker ${middle(times.worker).toFixed(0)} ms, three.js ${middle(times.three).toFixed(0)} ms (${middle(main_).toFixed(2)}×, ${middle(worker).toFixed(2)}×)`);
      }
    } finally {
      await browser.close();
      server.close();
    }
    figures.push(
      timed('all: three.js over loadGltf, geometric mean of medians', '1', [geometricMean(ratios.main)], quick ? undefined : { value: 1.5, relation: '>=', source: 'half as fast again' }),
      timed('all: three.js over loadGltfInWorker, geometric mean of medians', '1', [geometricMean(ratios.worker)]),
    );
    return {
      settings: { runs, models: models.map(({ name }) => name), browser: 'Chromium, headless' },
      figures,
      notes: ['A scene of ours holds decoded pixels and tangents where materials need them; three.js leaves pictures as bitmaps for the graphics card, and tangents to its shaders.'],
    };
  },
};

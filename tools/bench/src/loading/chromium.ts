import { copyFileSync, existsSync, mkdirSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { launchChromium, packedBrowser } from '../browser/chromium';
import { serveFolders } from '../browser/serve';
import { ASSETS, type Contestant, type From, type Load } from './models';

const COUNT = `const count = (scene) => scene.instances.reduce((sum, { mesh }) => sum + scene.meshes[mesh].indices.length / 3, 0);`;
const OURS = `
import { loadGltf } from '@glanz/gltf';
import { GltfWorker } from '@glanz/gltf/workers';
const meshopt = async () => (await import('meshoptimizer/decoder')).MeshoptDecoder;
// Kept between loads, as three.js keeps its own.
let module;
const draco = () => (module ??= import('draco3dgltf/draco_decoder_gltf_nodejs.js').then(({ default: create }) => create({ locateFile: () => '/draco.wasm' })));
${COUNT}
globalThis.loaders.glanz = async (input) => count(await loadGltf(input, { decoders: { meshopt, draco } }));
const worker = new GltfWorker({ createWorker: () => new Worker('/own-worker.js', { type: 'module' }) });
globalThis.loaders.worker = async (input) => count(await worker.load(input, { transfer: true }));
`;
const WORKER = `
import { serveGltf } from '@glanz/gltf/worker';
let module;
serveGltf({ decoders: {
  meshopt: async () => (await import('meshoptimizer/decoder')).MeshoptDecoder,
  draco: () => (module ??= import('draco3dgltf/draco_decoder_gltf_nodejs.js').then(({ default: create }) => create({ locateFile: () => '/draco.wasm' }))),
} });
`;
const THREE = `
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { DRACOLoader } from 'three/examples/jsm/loaders/DRACOLoader.js';
import { MeshoptDecoder } from 'three/examples/jsm/libs/meshopt_decoder.module.js';
const draco = new DRACOLoader().setDecoderPath('/three-draco/');
globalThis.loaders.three = async (input) => {
  const loader = new GLTFLoader().setDRACOLoader(draco).setMeshoptDecoder(MeshoptDecoder);
  const { scene } = await (typeof input === 'string' ? loader.loadAsync(input) : loader.parseAsync(input, ''));
  let triangles = 0;
  scene.traverse(({ isMesh, isInstancedMesh, count, geometry }) => { if (isMesh) triangles += ((geometry.index ?? geometry.attributes.position).count / 3) * (isInstancedMesh ? count : 1); });
  return triangles;
};
`;

/** Bundles with the sources of the workspace, for the page. */
async function bundle(contents: string, folder: string, legible: boolean): Promise<Uint8Array> {
  const { build } = await import('esbuild');
  const { weslSource } = await import('../../../pipeline/wesl.mjs');
  const { outputFiles } = await build({
    stdin: { contents, resolveDir: folder },
    bundle: true,
    write: false,
    format: 'esm',
    minify: !legible,
    target: 'es2022',
    conditions: ['@glanz/source'],
    external: ['fs', 'path', 'crypto', 'node:*'],
    define: { 'process.versions': '{}' },
    plugins: [weslSource()],
    logLevel: 'error',
  });
  return outputFiles[0]!.contents;
}

/** Writes the page with all loaders into a folder. */
export async function buildLoaders(out: string, legible: boolean): Promise<void> {
  const folder = resolve('tools/bench'),
    gltf = resolve('packages/gltf');
  const require = createRequire(join(gltf, 'package.json')),
    requireThree = createRequire(join(folder, 'package.json'));
  mkdirSync(join(out, 'three-draco'), { recursive: true });
  writeFileSync(
    join(out, 'index.html'),
    '<!doctype html><script>globalThis.loaders = {};</script><script type="module" src="/ours.js"></script><script type="module" src="/three.js"></script>',
  );
  writeFileSync(join(out, 'ours.js'), await bundle(OURS, gltf, legible));
  writeFileSync(join(out, 'own-worker.js'), await bundle(WORKER, gltf, legible));
  writeFileSync(join(out, 'three.js'), await bundle(THREE, folder, legible));
  copyFileSync(join(dirname(require.resolve('draco3dgltf')), 'draco_decoder_gltf.wasm'), join(out, 'draco.wasm'));
  const threeDraco = join(dirname(requireThree.resolve('three')), '../examples/jsm/libs/draco/gltf');
  for (const name of ['draco_decoder.js', 'draco_wasm_wrapper.js', 'draco_decoder.wasm'])
    if (existsSync(join(threeDraco, name))) copyFileSync(join(threeDraco, name), join(out, 'three-draco', name));
}

async function serve(legible: boolean) {
  const packed = packedBrowser();
  const name = legible ? 'loaders-legible' : 'loaders';
  const folder = packed === undefined ? resolve('.cache', name) : join(packed, name);
  if (packed === undefined) await buildLoaders(folder, legible);
  return serveFolders({ '/': folder, '/assets/': ASSETS });
}

/**
 * A page in Chromium with all loaders.
 *
 * @param legible Whether functions keep their names, for profiles.
 */
export async function openPage(legible = false) {
  const { browser } = await launchChromium();
  const server = await serve(legible);
  const page = await browser.newPage();
  await page.goto(`${server.origin}/`);
  await page.waitForFunction(
    () =>
      'three' in (globalThis as unknown as { loaders: object }).loaders &&
      'worker' in (globalThis as unknown as { loaders: object }).loaders,
  );
  const load = (loader: Contestant, file: string, from: From): Promise<Load> =>
    page.evaluate(
      async ([name, address, where]) => {
        const input = where === 'address' ? address! : await (await fetch(address!)).arrayBuffer();
        const begun = performance.now();
        const triangles = await (
          globalThis as unknown as { loaders: Record<string, (input: string | ArrayBuffer) => Promise<number>> }
        ).loaders[name!]!(input);
        return { ms: performance.now() - begun, triangles };
      },
      [loader, `/assets/${file.split('/').map(encodeURIComponent).join('/')}`, from],
    );
  return {
    version: browser.version(),
    page,
    load,
    /** The longest task of the page's own thread while a model is loaded, milliseconds of that thread's time. */
    async longestTask(loader: Contestant, file: string): Promise<number> {
      await browser.startTracing(page, { categories: ['__metadata', 'toplevel', 'devtools.timeline'] });
      await load(loader, file, 'address');
      const { traceEvents } = JSON.parse((await browser.stopTracing()).toString()) as {
        traceEvents: { name: string; ph: string; pid: number; tid: number; tdur?: number; args?: { name?: string } }[];
      };
      const main = new Set(
        traceEvents
          .filter(({ name, args }) => name === 'thread_name' && args?.name === 'CrRendererMain')
          .map(({ pid, tid }) => `${pid}/${tid}`),
      );
      return Math.max(
        0,
        ...traceEvents
          .filter(({ ph, pid, tid, tdur }) => ph === 'X' && tdur !== undefined && main.has(`${pid}/${tid}`))
          .map(({ tdur }) => tdur! / 1000),
      );
    },
    async close() {
      await browser.close();
      await server.close();
    },
  };
}

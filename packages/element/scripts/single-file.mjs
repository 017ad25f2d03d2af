// Builds the whole element into one file, glanz-viewer.min.js: for pages without a bundler, from any origin. Its
// workers run the same file, so that nothing else is fetched for a plain .glb, and each serves what its name says. What
// only some pages need (OBJ and STL, HDR and EXR, meshopt, Draco, KTX2, large meshes, compact shapes, arrays beyond a
// binding, animations, a ground, guiding, noise targets, textures beyond a budget, haze and retroreflection, thin
// films, meshes that are replaced, light paths, light samples that are reused or bent by glass), what filters moving
// frames, and what saves images, lies beside it and is fetched by import() when it is needed.
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { join, resolve } from 'node:path';
import { build, transformSync } from 'esbuild';
import { preparePublished } from '../../../tools/pipeline/published-source.mjs';
import { weslSource } from '../../../tools/pipeline/wesl.mjs';
import { packedWasm } from './wasm.mjs';

const MAIN = 'glanz-viewer.min.js';

const ENTRY = `
import { defineGlanzViewer } from '../element/src/element';
import { serveBuilds } from '@glanz/bvh/worker';
import { serveGltf } from '../gltf/src/worker/serve';
export { GlanzError, loadPart } from '@glanz/wgsl/error';

if (typeof WorkerGlobalScope === 'undefined') defineGlanzViewer();
else if (self.name === 'glanz-gltf') serveGltf();
else if (self.name === 'glanz-bvh') {
  serveBuilds({ post: (message, transfer = []) => self.postMessage(message, transfer), listen: (listener) => self.addEventListener('message', ({ data }) => listener(data)) });
}
`;

/** Modules that have files of their own, by the name that the sources import. */
const LATER = {
  '@glanz/formats/usd': 'glanz-viewer.usd.min.js',
  '@glanz/openpbr/lobes': 'glanz-viewer.lobes.min.js',
  '@glanz/openpbr/film': 'glanz-viewer.thin-film.min.js',
  '@glanz/image/environment': 'glanz-viewer.environment.min.js',
  'meshoptimizer/decoder': 'glanz-viewer.meshopt.min.js',
  './save-image': 'glanz-viewer.save.min.js',
  './material-colors': 'glanz-viewer.colors.min.js',
  './animation-player': 'glanz-viewer.animation.min.js',
  './stage': 'glanz-viewer.stage.min.js',
  './ldr-environment': 'glanz-viewer.ldr.min.js',
  './load-other': 'glanz-viewer.formats.min.js',
  './prompt': 'glanz-viewer.prompt.min.js',
  './realtime': 'glanz-viewer.realtime.min.js',
  './gpu-trees': 'glanz-viewer.gpu-trees.min.js',
  './guide-kernels': 'glanz-viewer.guide-kernels.min.js',
  './soft-shadows': 'glanz-viewer.soft-shadows.min.js',
  './rare-kernels': 'glanz-viewer.rare-kernels.min.js',
  './refracted-light': 'glanz-viewer.refracted-light.min.js',
  './light-kernels': 'glanz-viewer.light-kernels.min.js',
  './session/light-paths': 'glanz-viewer.light-paths.min.js',
  './reuse-kernels': 'glanz-viewer.reuse-kernels.min.js',
  './session/light-reuse': 'glanz-viewer.light-reuse.min.js',
  './paged/pages': 'glanz-viewer.pages.min.js',
  './paged-kernels': 'glanz-viewer.paged-kernels.min.js',
  './compact-shapes': 'glanz-viewer.compact-shapes.min.js',
  './compact-kernels': 'glanz-viewer.compact-kernels.min.js',
  './session/guide-training': 'glanz-viewer.guide.min.js',
  './noise-target': 'glanz-viewer.noise-target.min.js',
  './film-kernels': 'glanz-viewer.film-kernels.min.js',
  './fit-textures': 'glanz-viewer.fit-textures.min.js',
  './fit-images': 'glanz-viewer.fit-images.min.js',
  './replace-mesh': 'glanz-viewer.replace-mesh.min.js',
  './warm-up-scene': 'glanz-viewer.warm-up.min.js',
};

/** Where the modules of the sources among them are, from the viewer's folder. */
const SOURCES = {
  './save-image': './src/save-image',
  './material-colors': './src/material-colors',
  './animation-player': './src/animation-player',
  './stage': './src/stage',
  './ldr-environment': './src/ldr-environment',
  './load-other': './src/load-other',
  './prompt': '../element/src/prompt',
  './realtime': './src/realtime',
  '@glanz/openpbr/lobes': '../openpbr/src/wgsl/lobes/index',
  '@glanz/openpbr/film': '../openpbr/src/wgsl/thin_film/index',
  './gpu-trees': '../renderer/src/geometry/gpu-trees',
  './guide-kernels': '../renderer/src/integrator/guide-kernels',
  './soft-shadows': '../renderer/src/integrator/soft-shadows',
  './rare-kernels': '../renderer/src/integrator/rare-kernels',
  './refracted-light': '../renderer/src/integrator/refracted-light',
  './light-kernels': '../renderer/src/integrator/light-kernels',
  './session/light-paths': '../renderer/src/session/light-paths',
  './reuse-kernels': '../renderer/src/integrator/reuse-kernels',
  './session/light-reuse': '../renderer/src/session/light-reuse',
  './paged/pages': '../renderer/src/storage/paged/pages',
  './paged-kernels': '../renderer/src/integrator/paged-kernels',
  './compact-shapes': '../renderer/src/geometry/compact-shapes',
  './compact-kernels': '../renderer/src/integrator/compact-kernels',
  './session/guide-training': '../renderer/src/session/guide-training',
  './noise-target': '../renderer/src/schedule/noise-target',
  './film-kernels': '../renderer/src/integrator/film-kernels',
  './fit-textures': '../renderer/src/scene/fit-textures',
  './fit-images': '../gltf/src/fit-images',
  './replace-mesh': '../renderer/src/scene/replace-mesh',
  './warm-up-scene': '../renderer/src/warm-up-scene',
};

const pick = (...modules) => Object.fromEntries(modules.map((module) => [module, LATER[module]]));

/** What some of them use of others. */
const SHARED = {
  './animation-player': pick('meshoptimizer/decoder', './stage'),
  './load-other': pick('@glanz/formats/usd'),
};

/** The same for modules of src/decoders, by their names there; of each, what it exports. */
const DECODERS = {
  draco: { file: 'glanz-viewer.draco.min.js', exports: 'default' },
  basis: { file: 'glanz-viewer.basis.min.js', exports: 'default' },
  ktx2: { file: 'glanz-viewer.ktx2.min.js', exports: 'ktx2Decoder' },
};

/** What a module says of the other files of its package, and what it says where there is one file. */
const REPLACED = [
  [
    "new Worker(new URL('./worker.js', import.meta.url)",
    'new Worker(import.meta.url',
    ['bvh/src/worker/connection.ts', 'gltf/src/worker/load.ts'],
  ],
  ["new URL('./worker.js', url)", 'new URL(url)', ['bvh/src/worker/connection.ts', 'gltf/src/worker/load.ts']],
  ['if (port) serveBuilds(port);', '', ['bvh/src/worker/worker.ts']],
];

const SETTINGS = {
  bundle: true,
  minify: true,
  format: 'esm',
  platform: 'browser',
  target: 'es2022',
  conditions: ['@glanz/source'],
  define: { 'process.env.NODE_ENV': '"production"' },
  external: ['node:*'],
  legalComments: 'none',
  write: false,
};

/** The style sheet of the shadow tree, which no minifier of scripts looks into. */
const STYLE = /(\bconst STYLE = `)([^`]*)/;
const minifiedStyle = (style) => transformSync(style, { loader: 'css', minify: true, target: 'es2022' }).code.trim();

/** Modules that decode data when they are loaded; workers need none of it. */
const DEFERRED = new Set(['@glanz/openpbr/tables']);

/**
 * Imports modules of the same file statically: esbuild wraps each module that import() loads in a function, with all
 * that it imports, which takes about 1 kB.
 */
function importStatically(text, files) {
  const names = new Map();
  const body = text.replace(/\bimport\('((?:\.{1,2}|@glanz)\/[^']+)'\)/g, (all, module) => {
    if (DEFERRED.has(module) || Object.hasOwn(files, module) || Object.hasOwn(DECODERS, module.slice(2))) return all;
    if (!names.has(module)) names.set(module, `imported${names.size}`);
    return `Promise.resolve(${names.get(module)})`;
  });
  return body + [...names].map(([module, name]) => `\nimport * as ${name} from '${module}';`).join('');
}

/** Reads sources as they are published, with `REPLACED`; `missing` loses each text that was there. */
const sources = (missing, files) => ({
  name: 'sources',
  setup(context) {
    context.onLoad({ filter: /[\\/]src[\\/].*\.ts$/ }, async ({ path }) => {
      let text = await readFile(path, 'utf8');
      for (const [from, to, files] of REPLACED) {
        const file = files.find((one) => path.replaceAll('\\', '/').endsWith(one));
        if (!file || !text.includes(from)) continue;
        text = text.replaceAll(from, to);
        missing.delete(`${file}: ${from}`);
      }
      text = text.replace(STYLE, (_, before, style) => before + minifiedStyle(style));
      return { contents: importStatically(preparePublished(text, path), files), loader: 'ts' };
    });
  },
});

/** Resolves some modules to files beside the result. */
const beside = (files) => ({
  name: 'beside',
  setup(context) {
    context.onResolve({ filter: /^(@glanz|meshoptimizer|\.)\// }, ({ path }) =>
      Object.hasOwn(files, path) ? { path: `./${files[path]}`, external: true } : undefined,
    );
    context.onResolve({ filter: /^\.\/(draco|basis|ktx2)$/ }, ({ path, importer }) =>
      /[\\/]decoders[\\/]index\.ts$/.test(importer)
        ? { path: `./${DECODERS[path.slice(2)].file}`, external: true }
        : undefined,
    );
  },
});

/**
 * @param {string} folder The package's.
 * @param {string} to Where the files go.
 * @returns {Promise<string[]>} Their names, that of the single file first.
 */
export async function buildSingleFile(folder, to) {
  const missing = new Set(REPLACED.flatMap(([from, , files]) => files.map((file) => `${file}: ${from}`)));
  const resolveDir = resolve(folder, '../viewer');
  await mkdir(to, { recursive: true });
  const write = async (contents, name, files) => {
    const stdin = { contents, resolveDir, sourcefile: name, loader: 'js' };
    const { outputFiles } = await build({
      ...SETTINGS,
      stdin,
      plugins: [beside(files), packedWasm(folder), weslSource({ shrink: true }), sources(missing, files)],
    });
    await writeFile(join(to, name), outputFiles[0].contents);
    return name;
  };
  const names = [await write(ENTRY, MAIN, LATER)];
  if (missing.size > 0)
    throw new Error(
      `The single file cannot be built, since these texts are not in the sources any more: ${[...missing].join('; ')}.`,
    );
  // Their errors are of the same class.
  for (const [module, name] of Object.entries(LATER))
    names.push(
      await write(`export * from '${SOURCES[module] ?? module}';`, name, {
        '@glanz/wgsl/error': MAIN,
        ...SHARED[module],
      }),
    );
  for (const [module, { file, exports }] of Object.entries(DECODERS))
    names.push(
      await write(`export { ${exports} } from '../element/src/decoders/${module}';`, file, {
        '@glanz/wgsl/error': MAIN,
      }),
    );
  return names;
}

import { readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';
import { weslSource } from '../../pipeline/wesl.mjs';

const folder = dirname(fileURLToPath(import.meta.url));

/** Names of all benchmarks: the files in `benchmarks/`. */
export function benchmarkNames() {
  return readdirSync(join(folder, 'benchmarks'))
    .filter((file) => file.endsWith('.ts'))
    .map((file) => file.slice(0, -3))
    .sort();
}

/**
 * Bundles one benchmark with its runner into one ESM file, straight from the sources of the workspace. `webgpu` stays
 * outside: it is a native module, and GPU_WEBGPU may name another copy at run time.
 */
export async function bundleBenchmark(name, outfile) {
  // It starts the command as a process of its own, from beside its file.
  if (name === 'farm-gpus')
    await bundle(
      "import { runCli } from '@glanz/cli';\nprocess.exitCode = await runCli(process.argv.slice(2));\n",
      join(dirname(outfile), 'glanz.js'),
    );
  await bundle(
    `import { benchmark } from './benchmarks/${name}';\nimport { benchmarkMain } from './runner';\nawait benchmarkMain(${JSON.stringify(name)}, benchmark, process.argv.slice(2));\n`,
    outfile,
    name === 'hashes' ? [observedWgsl] : [],
  );
}

/** Draco looks for its WebAssembly beside its own file, so it stays where the loader finds it. */
const draco = {
  name: 'draco',
  setup: (context) =>
    context.onResolve({ filter: /^draco3dgltf$/ }, ({ path }) => ({
      path: pathToFileURL(createRequire(join(folder, '../../../packages/gltf/package.json')).resolve(path)).href,
      external: true,
    })),
};

/** `hashes` looks at the programs that the renderer composes, see hashes/observed-wgsl.ts. */
const observedWgsl = {
  name: 'observed-wgsl',
  setup: (context) =>
    context.onResolve({ filter: /^@glanz\/wgsl$/ }, ({ importer }) =>
      /[\\/]packages[\\/]renderer[\\/]src[\\/]/.test(importer)
        ? { path: join(folder, 'hashes/observed-wgsl.ts') }
        : undefined,
    ),
};

/** Bundles TypeScript text that stands in this folder. */
export async function bundle(contents, outfile, plugins = []) {
  await build({
    stdin: { contents, resolveDir: folder, loader: 'ts' },
    outfile,
    bundle: true,
    platform: 'node',
    format: 'esm',
    target: 'node20',
    conditions: ['@glanz/source'],
    external: ['webgpu', 'sharp', 'esbuild', 'vite', 'playwright', '@sparticuz/chromium'],
    // CommonJS dependencies expect a require to be there.
    banner: {
      js: "import { createRequire as __createRequire } from 'node:module'; const require = __createRequire(import.meta.url);",
    },
    plugins: [weslSource(), draco, ...plugins],
    logLevel: 'error',
  });
}

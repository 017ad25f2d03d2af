// node packages/gltf/test/fuzz/pack.mjs FILE — the fuzzer with its documents and decoders as one file that needs
// nothing but Node:
//   node FILE --count 1000000 --threads 16 --json report.json
import { mkdirSync, mkdtempSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const out = resolve(process.argv[2] ?? 'fuzz-gltf.mjs');
const common = {
  bundle: true,
  format: 'esm',
  platform: 'node',
  target: 'node20',
  conditions: ['@glanz/source'],
  logLevel: 'error',
};

// The documents, as the test has them.
const folder = mkdtempSync(join(here, '../../node_modules/.fuzz-'));
let documents;
try {
  const file = join(folder, 'seeds.mjs');
  const { outputFiles } = await build({
    ...common,
    entryPoints: [join(here, 'seeds.ts')],
    write: false,
    external: ['draco3dgltf', 'meshoptimizer', 'meshoptimizer/*', '@gltf-transform/*'],
    define: { 'import.meta.url': JSON.stringify(pathToFileURL(join(here, '../shared.ts')).href) },
  });
  writeFileSync(file, outputFiles[0].contents);
  const { seeds } = await import(pathToFileURL(file).href);
  documents = JSON.stringify(
    (await seeds()).map(({ json, binary }) =>
      binary ? { json, binary: Buffer.from(binary).toString('base64') } : { json },
    ),
  );
} finally {
  rmSync(folder, { recursive: true, force: true });
}

/** Draco reads its WebAssembly from beside its own file; here it is passed as bytes. */
const draco = {
  name: 'draco',
  setup(context) {
    context.onResolve({ filter: /^draco3dgltf$/ }, () => ({ path: 'draco', namespace: 'draco' }));
    context.onLoad({ filter: /.*/, namespace: 'draco' }, () => ({
      contents:
        "import create from 'draco3dgltf/draco_decoder_gltf_nodejs.js';\nimport wasmBinary from 'draco3dgltf/draco_decoder_gltf.wasm';\nexport default { createDecoderModule: () => create({ wasmBinary }) };",
      resolveDir: here,
    }));
  },
};
mkdirSync(dirname(out), { recursive: true });
await build({
  ...common,
  entryPoints: [join(here, 'alone.ts')],
  outfile: out,
  minifySyntax: true,
  loader: { '.wasm': 'binary' },
  external: ['sharp'],
  // Importing the worker is what makes a thread one.
  ignoreAnnotations: true,
  plugins: [draco],
  define: { FUZZ_DOCUMENTS: JSON.stringify(documents) },
  banner: {
    js: "import { createRequire as __createRequire } from 'node:module'; import { dirname as __dir } from 'node:path'; import { fileURLToPath as __toPath } from 'node:url'; const require = __createRequire(import.meta.url); const __filename = __toPath(import.meta.url); const __dirname = __dir(__filename);",
  },
});
process.stdout.write(`${out} ${(statSync(out).size / 1024).toFixed(0)} KiB\n`);

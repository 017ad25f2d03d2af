// What the decoders' modules become in a build: WebAssembly is held by the module itself, compressed, so that any
// bundler, any server and any origin serves it as it does a script; and the scripts that Emscripten wrote do not look
// for Node, which bundlers would try to find modules for.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { deflateRawSync } from 'node:zlib';
import { withDefault } from '../../../tools/pipeline/basis-module.mjs';

/** The WebAssembly behind each module. */
const WASM = {
  'draco-wasm.ts': 'draco3dgltf/draco_decoder_gltf.wasm',
  'basis-wasm.ts': 'three/examples/jsm/libs/basis/basis_transcoder.wasm',
};

const GLUE = /[\\/](draco_decoder_gltf_nodejs|basis_transcoder)\.js$/;

/** A plugin of esbuild. @param {string} folder The package's. */
export const packedWasm = (folder) => ({
  name: 'packed-wasm',
  setup(context) {
    const { resolve } = createRequire(join(folder, 'package.json'));
    context.onLoad({ filter: /[\\/]decoders[\\/](draco|basis)-wasm\.ts$/ }, async ({ path }) => {
      const packed = deflateRawSync(await readFile(resolve(WASM[path.replace(/.*[\\/]/, '')])), { level: 9 });
      const contents = `const packed = ${JSON.stringify(packed.toString('base64'))};
export function wasmBytes() {
  const bytes = Uint8Array.from(atob(packed), (c) => c.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'))).arrayBuffer();
}`;
      return { contents, loader: 'js' };
    });
    context.onLoad({ filter: GLUE }, async ({ path }) => ({
      contents: `var process, __filename, __dirname;\n${withDefault(await readFile(path, 'utf8'), path)}`,
      loader: 'js',
    }));
    context.onResolve({ filter: /^(fs|path)$/ }, ({ path, importer }) =>
      GLUE.test(importer) ? { path, namespace: 'no-node' } : undefined,
    );
    context.onLoad({ filter: /.*/, namespace: 'no-node' }, () => ({ contents: 'module.exports = {};' }));
  },
});

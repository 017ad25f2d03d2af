import { gzipSync } from 'node:zlib';

/**
 * Bundles a snippet as a consumer's build would: published files only, minified.
 *
 * @param {{ folder: string }} consumer from installPacked()
 * @param {string} code
 * @param {{ external?: string[], keepEffects?: boolean }} options `keepEffects`: do not believe `sideEffects: false`.
 * @returns {Promise<{ text: string, bytes: number, gzip: number, inputs: Record<string, number> }>} `inputs`: bytes in the output by file.
 */
export async function bundle({ folder }, code, { external = [], keepEffects = false } = {}) {
  const { build } = await import('esbuild');
  const result = await build({
    stdin: { contents: code, resolveDir: folder, loader: 'js', sourcefile: 'entry.js' },
    bundle: true,
    minify: true,
    write: false,
    metafile: true,
    format: 'esm',
    platform: 'neutral',
    mainFields: ['module', 'main'],
    target: 'es2022',
    legalComments: 'none',
    external: ['node:*', ...external],
    logLevel: 'silent',
    plugins: [
      {
        name: 'consumer',
        setup(context) {
          if (!keepEffects) return;
          context.onResolve({ filter: /.*/ }, async ({ path, ...args }) => {
            if (args.pluginData === 'resolved' || args.kind === 'entry-point') return undefined;
            const resolved = await context.resolve(path, { ...args, pluginData: 'resolved' });
            return { ...resolved, pluginData: undefined, sideEffects: true };
          });
        },
      },
    ],
  });
  const [file] = result.outputFiles;
  const [output] = Object.values(result.metafile.outputs);
  return {
    text: file.text,
    bytes: file.contents.byteLength,
    gzip: file.text.trim() === '' ? 0 : gzipSync(file.contents, { level: 9 }).byteLength,
    inputs: Object.fromEntries(Object.entries(output.inputs).map(([path, { bytesInOutput }]) => [path, bytesInOutput])),
  };
}

/** Optional peers and native modules: never part of a library's weight. */
export const PEERS = ['sharp', 'meshoptimizer', 'meshoptimizer/*', 'webgpu', '@sparticuz/chromium', 'draco3dgltf', 'ktx-parse'];

import { gzipSync } from 'node:zlib';

/**
 * Bundles a snippet as a consumer's build would: published files only, minified.
 *
 * @param {{ folder: string }} consumer from installPacked()
 * @param {string} code
 * @param {{ external?: string[], keepEffects?: boolean }} options `keepEffects`: do not believe `sideEffects: false`.
 * @returns {Promise<{ text: string, bytes: number, gzip: number, lazy: number, inputs: Record<string, number> }>} What
 * is there when the snippet is imported; `lazy`: gzipped bytes of the chunks that come by `import()` later; `inputs`:
 * bytes in the output by file.
 */
export async function bundle({ folder }, code, { external = [], keepEffects = false } = {}) {
  const { build } = await import('esbuild');
  const result = await build({
    stdin: { contents: code, resolveDir: folder, loader: 'js', sourcefile: 'entry.js' },
    bundle: true,
    splitting: true,
    outdir: folder,
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
            // What comes later may do what it likes; its share of common code would count as run now.
            if (args.kind === 'dynamic-import') return { path, external: true };
            const resolved = await context.resolve(path, { ...args, pluginData: 'resolved' });
            return { ...resolved, pluginData: undefined, sideEffects: true };
          });
        },
      },
    ],
  });
  const { outputs } = result.metafile;
  const entry = Object.keys(outputs).find((path) => outputs[path].entryPoint?.endsWith('entry.js'));
  const found = new Set([entry]);
  for (const path of found)
    for (const { path: next, kind, external: left } of outputs[path].imports)
      if (!left && kind === 'import-statement') found.add(next);
  const files = Object.keys(outputs).map((path, i) => ({
    path,
    contents: result.outputFiles[i].contents,
    text: result.outputFiles[i].text,
  }));
  const there = files.filter(({ path }) => found.has(path));
  const gzip = (some) =>
    some.reduce(
      (sum, { text, contents }) => sum + (text.trim() === '' ? 0 : gzipSync(contents, { level: 9 }).byteLength),
      0,
    );
  const inputs = {};
  for (const { path } of there)
    for (const [input, { bytesInOutput }] of Object.entries(outputs[path].inputs))
      inputs[input] = (inputs[input] ?? 0) + bytesInOutput;
  return {
    text: there.map(({ text }) => text).join(''),
    bytes: there.reduce((sum, { contents }) => sum + contents.byteLength, 0),
    gzip: gzip(there),
    lazy: gzip(files.filter(({ path }) => !found.has(path))),
    inputs,
  };
}

/** Peers and native modules: never part of a library's weight. */
export const PEERS = [
  'sharp',
  'meshoptimizer',
  'meshoptimizer/*',
  'webgpu',
  '@sparticuz/chromium',
  'draco3dgltf',
  'ktx-parse',
  'mediabunny',
  'react',
  '@react-three/fiber',
  'three',
];

// What scripts of the documentation run: bundles of its sources and those of the packages, of which Node reads neither.
import { mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';
import { weslSource } from '../../../tools/pipeline/wesl.mjs';

/** The path of a file, relative to this folder. */
export const at = (path) => fileURLToPath(new URL(path, import.meta.url));

/** Bundles TypeScript text that stands in `src/`; what is native stays outside. */
export const bundleSources = (contents, outfile) =>
  build({
    stdin: { contents, resolveDir: at('../src'), loader: 'ts' },
    outfile,
    conditions: ['@glanz/source'],
    bundle: true,
    format: 'esm',
    platform: 'node',
    target: 'node20',
    plugins: [weslSource()],
    external: ['webgpu', 'esbuild', 'playwright', '@sparticuz/chromium'],
  });

/**
 * Runs a task with a module of `src/`, and a folder for its files, which is removed afterwards.
 *
 * @param {string} name Of the module.
 * @param {(module: any, folder: string) => Promise<void>} task
 */
export async function withSources(name, task) {
  mkdirSync(at('../.vitepress/cache'), { recursive: true });
  const folder = mkdtempSync(at(`../.vitepress/cache/${name}-`));
  try {
    const outfile = join(folder, `${name}.mjs`);
    await bundleSources(`export * from './${name}';\n`, outfile);
    await task(await import(pathToFileURL(outfile).href), folder);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

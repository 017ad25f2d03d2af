import { copyFileSync, mkdirSync, statSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';
import { weslSource } from '../../pipeline/wesl.mjs';

const folder = dirname(fileURLToPath(import.meta.url));
const root = join(folder, '../../..');

/** Archives of weights of `--denoise balanced` and `fast`; `best` needs 22 MiB more than is carried to other machines. */
const WEIGHTS = ['rt_hdr_alb_nrm', 'rt_hdr_alb_nrm_small'];

/** Draco looks for its WebAssembly beside its own file, so it stays where the loader finds it. */
const draco = {
  name: 'draco',
  setup: (context) =>
    context.onResolve({ filter: /^draco3dgltf$/ }, ({ path }) => ({
      path: pathToFileURL(createRequire(join(root, 'packages/gltf/package.json')).resolve(path)).href,
      external: true,
    })),
};

/**
 * Bundles the tool with the command and the generators of the models into `out/lib/gallery.mjs`, and copies the weights
 * of the denoiser to `out/weights`, where the bundle looks for them. It needs Node and `webgpu` alone.
 *
 * @returns Bytes of all files.
 */
export async function bundleGallery(out, { weights = true } = {}) {
  mkdirSync(join(out, 'lib'), { recursive: true });
  mkdirSync(join(out, 'weights'), { recursive: true });
  const outfile = join(out, 'lib/gallery.mjs');
  await build({
    stdin: {
      contents:
        "import { galleryMain } from './gallery';\nprocess.exitCode = await galleryMain(process.argv.slice(2));\n",
      resolveDir: folder,
      loader: 'ts',
    },
    outfile,
    bundle: true,
    platform: 'node',
    format: 'esm',
    target: 'node20',
    conditions: ['@glanz/source'],
    external: ['webgpu', 'sharp', 'esbuild', 'vite', '@sparticuz/chromium'],
    banner: {
      js: "import { createRequire as __createRequire } from 'node:module'; const require = __createRequire(import.meta.url);",
    },
    plugins: [weslSource(), draco],
    logLevel: 'error',
  });
  // The command reads its version beside its folder.
  copyFileSync(join(root, 'packages/cli/package.json'), join(out, 'package.json'));
  let bytes = statSync(outfile).size;
  for (const name of weights ? WEIGHTS : []) {
    const target = join(out, `weights/${name}.tza`);
    copyFileSync(join(root, `packages/denoise-weights/weights/${name}.tza`), target);
    bytes += statSync(target).size;
  }
  return bytes;
}

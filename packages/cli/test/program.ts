import { dirname } from 'node:path';
import { mkdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import { weslSource } from '../../../tools/pipeline/wesl.mjs';

/** Bundles `glanz` from the sources into one file, so that it runs whether or not the packages have been built. */
export async function bundleProgram(outfile: string): Promise<void> {
  mkdirSync(dirname(outfile), { recursive: true });
  await build({
    entryPoints: [fileURLToPath(new URL('../src/glanz.ts', import.meta.url))],
    outfile,
    bundle: true,
    platform: 'node',
    format: 'esm',
    target: 'node20',
    conditions: ['@glanz/source'],
    external: [
      'webgpu',
      'sharp',
      '@sparticuz/chromium',
      'draco3dgltf',
      'meshoptimizer',
      'meshoptimizer/*',
      'bullmq',
      'ioredis',
      '@aws-sdk/client-s3',
    ],
    // Some dependencies of dependencies are CommonJS and ask for Node's modules by require().
    banner: {
      js: "import { createRequire as glanzRequire } from 'node:module'; const require = glanzRequire(import.meta.url);",
    },
    plugins: [weslSource()],
    logLevel: 'error',
  });
}

import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { Worker } from 'node:worker_threads';
import { build } from 'esbuild';
import { fuzzOn, type FuzzPlan, type FuzzReport } from './pool';
import { seeds } from './seeds';

/** Loads spoiled documents on several threads, from the sources. */
export async function fuzz(plan: Omit<FuzzPlan, 'parts'>): Promise<FuzzReport> {
  const parts = await seeds();
  const here = fileURLToPath(new URL('.', import.meta.url));
  // Beside the package, so that what is not bundled is found.
  const folder = mkdtempSync(join(here, '../../node_modules/.fuzz-'));
  const file = join(folder, 'worker.mjs');
  try {
    const { outputFiles } = await build({
      entryPoints: [join(here, 'worker.ts')],
      bundle: true,
      write: false,
      format: 'esm',
      platform: 'node',
      target: 'node20',
      conditions: ['@glanz/source'],
      external: ['draco3dgltf', 'meshoptimizer', 'sharp', '@gltf-transform/*'],
    });
    writeFileSync(file, outputFiles[0]!.contents);
    return await fuzzOn(
      (workerData) => new Worker(pathToFileURL(file), { workerData, resourceLimits: { maxOldGenerationSizeMb: 1024 } }),
      { ...plan, parts },
    );
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { Worker } from 'node:worker_threads';
import { build } from 'esbuild';

/** The worker's sources as one file that Node can load, and what takes it away again. */
export async function bundledWorker(): Promise<{ file: string; start: () => Worker; remove: () => void }> {
  const folder = mkdtempSync(join(tmpdir(), 'glanz-bvh-'));
  const file = join(folder, 'worker.mjs');
  await build({
    entryPoints: [fileURLToPath(new URL('../../src/worker/worker.ts', import.meta.url))],
    outfile: file,
    bundle: true,
    format: 'esm',
    platform: 'neutral',
    target: 'es2022',
    conditions: ['@glanz/source'],
    logLevel: 'error',
  });
  return { file, start: () => new Worker(file), remove: () => rmSync(folder, { recursive: true, force: true }) };
}

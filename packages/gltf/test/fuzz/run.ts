import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { Worker } from 'node:worker_threads';
import { build } from 'esbuild';
import { seeds } from './seeds';
import type { FuzzFinding, FuzzTask } from './worker';

/** A worker that says nothing for so long hangs. */
const SILENCE_MS = 20_000;

/**
 * Loads spoiled documents on several threads.
 *
 * @param seed The same seed gives the same mutants, whatever the number of threads.
 * @returns Bad ends, at most 20.
 */
export async function fuzz({ count, seed, first = 0, threads = 2, onProgress }: { count: number; seed: number; first?: number; threads?: number; onProgress?: (done: number) => void }): Promise<FuzzFinding[]> {
  const parts = await seeds();
  const here = fileURLToPath(new URL('.', import.meta.url));
  // Beside the package, so that what is not bundled is found.
  const folder = mkdtempSync(join(here, '../../node_modules/.fuzz-'));
  const file = join(folder, 'worker.mjs');
  const { outputFiles } = await build({ entryPoints: [join(here, 'worker.ts')], bundle: true, write: false, format: 'esm', platform: 'node', target: 'node20', conditions: ['@glanz/source'], external: ['draco3dgltf', 'meshoptimizer', 'sharp', '@gltf-transform/*'] });
  writeFileSync(file, outputFiles[0]!.contents);
  const findings: FuzzFinding[] = [];
  let done = 0;
  const run = (start: number): Promise<void> =>
    new Promise((resolve) => {
      let at = start;
      const task: FuzzTask = { parts, seed, first: start, end: first + count, step: threads };
      const worker = new Worker(pathToFileURL(file), { workerData: task, resourceLimits: { maxOldGenerationSizeMb: 1024 } });
      let timer: NodeJS.Timeout | undefined;
      let over = false;
      const finish = () => {
        over = true;
        clearTimeout(timer);
        void worker.terminate().then(() => resolve());
      };
      /** Goes on behind a mutant that ended the worker. */
      const lose = (what: string) => {
        if (over) return;
        findings.push({ mutant: at, what });
        over = true;
        clearTimeout(timer);
        void worker.terminate().then(() => (findings.length < 20 && at + threads < first + count ? run(at + threads) : undefined)).then(() => resolve());
      };
      const watch = () => {
        clearTimeout(timer);
        timer = setTimeout(() => lose(`says nothing for ${SILENCE_MS / 1000} s`), SILENCE_MS);
      };
      worker.on('message', (message: { at?: number; finding?: FuzzFinding; done?: true }) => {
        watch();
        if (message.at !== undefined) {
          at = message.at;
          if (++done % 10_000 === 0) onProgress?.(done);
        }
        if (message.finding && findings.push(message.finding) >= 20) finish();
        if (message.done) finish();
      });
      worker.on('error', (error) => lose(`ends its thread: ${error.message}`));
      worker.on('exit', () => lose('ends its thread'));
      watch();
    });
  try {
    await Promise.all(Array.from({ length: threads }, (_, i) => run(first + i)));
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
  return findings.slice(0, 20);
}

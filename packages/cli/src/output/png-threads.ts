import { existsSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { fileURLToPath } from 'node:url';
import { Worker } from 'node:worker_threads';
import type { PngBand } from '@glanz/image/png';
import { CliError } from '../errors';
import type { LinearBand } from './png-bands';

/** More do not help: the rest takes longer than the bands. */
const MAX_THREADS = 8;

/** The script of the threads, beside this file in the package; absent where it runs from elsewhere. */
const SCRIPT = fileURLToPath(new URL('./png-worker.js', import.meta.url));

/** Has the next band made by a thread. */
const ask = (worker: Worker, band: LinearBand): Promise<PngBand> =>
  new Promise((resolve, reject) => {
    const ended = () =>
      reject(new CliError('cli/output', 'A thread that compresses the PNG file ended early: is there enough memory?'));
    worker.once('error', reject).once('exit', ended);
    worker.once('message', (made: PngBand) => {
      worker.off('error', reject).off('exit', ended);
      resolve(made);
    });
    worker.postMessage(band, [band.beauty.buffer]);
  });

/**
 * Bands of an image, by several threads.
 *
 * @param count How many they are.
 * @param band Copies the pixels of one.
 * @param file The script of the threads.
 * @returns The bands in their order, the same bytes as of one thread; `undefined` where there are no threads.
 * @throws {CliError} `cli/output` where a thread ends before its band is made
 */
export async function bandsOnThreads(
  count: number,
  band: (index: number) => LinearBand,
  file = SCRIPT,
): Promise<readonly PngBand[] | undefined> {
  const threads = Math.min(MAX_THREADS, availableParallelism(), count);
  if (threads < 2 || !existsSync(file)) return undefined;
  const bands: PngBand[] = [];
  let next = 0;
  const workers = Array.from({ length: threads }, () => new Worker(file));
  try {
    await Promise.all(
      workers.map(async (worker) => {
        while (next < count) {
          const index = next++;
          bands[index] = await ask(worker, band(index));
        }
      }),
    );
  } finally {
    await Promise.all(workers.map((worker) => worker.terminate()));
  }
  return bands;
}

import type { Worker } from 'node:worker_threads';
import type { FuzzFinding, FuzzMessage, FuzzTask } from './worker';

/** A worker that says nothing for so long hangs. */
const SILENCE_MS = 20_000;
/** Bad ends after which there is no need for more. */
const ENOUGH = 20;

/** What to load: mutants from `first` on. The same seed gives the same ones, whatever the number of threads. */
export interface FuzzPlan extends Pick<FuzzTask, 'parts' | 'seed'> {
  readonly count: number;
  readonly first?: number;
  readonly threads?: number;
  readonly onProgress?: (done: number) => void;
}

export interface FuzzReport {
  /** At most 20. */
  readonly findings: readonly FuzzFinding[];
  /** How often each end was: `scene`, or an error's code. Workers that ended early have not reported. */
  readonly ends: Readonly<Record<string, number>>;
  /** Mutants that were begun. */
  readonly done: number;
}

/** Loads spoiled documents on several threads. @param start Starts a worker that runs `worker.ts`. */
export async function fuzzOn(
  start: (task: FuzzTask) => Worker,
  { parts, seed, count, first = 0, threads = 2, onProgress }: FuzzPlan,
): Promise<FuzzReport> {
  const findings: FuzzFinding[] = [];
  const ends: Record<string, number> = {};
  let done = 0;
  const run = (begin: number): Promise<void> =>
    new Promise((resolve) => {
      let at = begin;
      const worker = start({ parts, seed, first: begin, end: first + count, step: threads });
      let timer: NodeJS.Timeout | undefined;
      let over = false;
      const finish = () => {
        over = true;
        clearTimeout(timer);
        void worker.terminate().then(() => resolve());
      };
      /** Continues after a mutant that ended the worker. */
      const lose = (what: string) => {
        if (over) return;
        findings.push({ mutant: at, what });
        over = true;
        clearTimeout(timer);
        void worker
          .terminate()
          .then(() => (findings.length < ENOUGH && at + threads < first + count ? run(at + threads) : undefined))
          .then(() => resolve());
      };
      const watch = () => {
        clearTimeout(timer);
        timer = setTimeout(() => lose(`says nothing for ${SILENCE_MS / 1000} s`), SILENCE_MS);
      };
      worker.on('message', (message: FuzzMessage) => {
        watch();
        if ('at' in message) {
          at = message.at;
          if (++done % 10_000 === 0) onProgress?.(done);
        } else if ('finding' in message) {
          if (findings.push(message.finding) >= ENOUGH) finish();
        } else {
          for (const [end, times] of Object.entries(message.done)) ends[end] = (ends[end] ?? 0) + times;
          finish();
        }
      });
      worker.on('error', (error) => lose(`ends its thread: ${error.message}`));
      worker.on('exit', () => lose('ends its thread'));
      watch();
    });
  await Promise.all(Array.from({ length: Math.min(threads, count) }, (_, i) => run(first + i)));
  return { findings: findings.slice(0, ENOUGH), ends, done };
}

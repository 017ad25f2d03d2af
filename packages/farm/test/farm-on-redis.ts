import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { startRedis, type RedisProgram, type RedisServer } from '@glanz/redis';
import { onTestFinished } from 'vitest';
import {
  contentId,
  FolderStore,
  openFarmQueue,
  startFarmWorker,
  type FarmJob,
  type FarmQueue,
  type FarmWorker,
  type FarmWorkerOptions,
  type WorkerEvent,
} from '../src/index';

/** A folder that is gone after the test. */
export function temporaryFolder(): string {
  const folder = mkdtempSync(join(tmpdir(), 'glanz-farm-'));
  onTestFinished(() => rmSync(folder, { recursive: true, force: true, maxRetries: 5 }));
  return folder;
}

/** A job whose payload says how `renderer.mjs` behaves. */
export const jobOf = (label: string, payload: object = {}): FarmJob => ({
  id: contentId([label, payload]),
  kind: 'image',
  label,
  payload: { text: `${label}\n`, ...payload },
});

/** A farm on a Redis of its own, with quick locks and heartbeats. */
export interface TestFarm {
  readonly folder: string;
  readonly store: FolderStore;
  readonly redis: RedisServer;
  readonly queue: FarmQueue;
  readonly events: WorkerEvent[];
  worker(options?: Partial<FarmWorkerOptions>): Promise<FarmWorker>;
  /** Waits until a condition holds, at most half a minute. */
  until(what: string, holds: () => Promise<boolean> | boolean): Promise<void>;
  /** Lines of the renderers' log that begin with these words. */
  log(words: string): string[];
  /** Jobs whose files go to `out`. */
  requests(jobs: readonly FarmJob[]): { job: FarmJob; destination: { root: string; paths: string[] } }[];
}

/** Starts a farm without workers. */
export async function testFarm(program: RedisProgram): Promise<TestFarm> {
  const folder = temporaryFolder();
  const redis = await startRedis(program, join(folder, 'redis'));
  const store = new FolderStore(join(folder, 'store'));
  const queue = await openFarmQueue({ redis: redis.url });
  const events: WorkerEvent[] = [];
  const workers: FarmWorker[] = [];
  const log = join(folder, 'log.txt');
  writeFileSync(log, '');
  onTestFinished(async () => {
    await Promise.all(workers.map((worker) => worker.drain().catch(() => undefined)));
    await queue.close();
    await redis.stop();
  });
  return {
    folder,
    store,
    redis,
    queue,
    events,
    async worker(options = {}) {
      const worker = await startFarmWorker({
        redis: redis.url,
        store,
        renderer: { script: fileURLToPath(new URL('renderer.mjs', import.meta.url)), args: [log] },
        lockMs: 2000,
        beatMs: 100,
        onEvent: (event) => void events.push(event),
        ...options,
      });
      workers.push(worker);
      return worker;
    },
    async until(what, holds) {
      for (const end = Date.now() + 30_000; Date.now() < end; await new Promise((done) => setTimeout(done, 25)))
        if (await holds()) return;
      throw new Error(`${what}: not after half a minute; ${JSON.stringify(await queue.status())}`);
    },
    log: (words) =>
      readFileSync(log, 'utf8')
        .split('\n')
        .filter((line) => line.startsWith(words)),
    requests: (jobs) =>
      jobs.map((job) => ({ job, destination: { root: join(folder, 'out'), paths: [`${job.label}.txt`] } })),
  };
}

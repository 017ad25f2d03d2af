import { rm, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { FarmError } from '../error';
import type { FarmJob } from '../job';
import { keysOf } from '../queue/keys';
import { connectRedis, importQueueModules, isRefusal, type BullQueue, type QueueModules } from '../queue/redis';
import type { FarmStore } from '../store/store';
import { FarmWorker, type FarmWorkerOptions } from './farm-worker';

const CONNECT_MS = 20_000;
const CONNECT_PAUSE_MS = 500;

/** The id of no job. */
const NONE = '0'.repeat(40);

/** Writes in a folder, and reads. A worker that cannot would fail one job after another. @throws {FarmError} */
async function checkStore(store: FarmStore): Promise<void> {
  try {
    const folder = await store.begin(NONE);
    await writeFile(join(folder, 'check'), NONE);
    await rm(folder, { recursive: true, force: true });
    await store.result(NONE);
  } catch (cause) {
    if (cause instanceof FarmError) throw cause;
    throw new FarmError('farm/store', `The store cannot be written: ${(cause as Error).message}.`, { cause });
  }
}

/** A Redis that restarts takes a few seconds. @throws {FarmError} `farm/redis` for one that does not answer at all */
async function untilRedisAnswers(
  modules: QueueModules,
  { redis, connectMs = CONNECT_MS, onEvent }: FarmWorkerOptions,
): Promise<void> {
  for (const end = Date.now() + connectMs; ; await new Promise((done) => setTimeout(done, CONNECT_PAUSE_MS))) {
    try {
      (await connectRedis(modules, redis, false)).disconnect();
      return;
    } catch (error) {
      if (!(error instanceof FarmError) || error.code !== 'farm/redis' || isRefusal(error.cause) || Date.now() >= end)
        throw error;
      onEvent?.({ type: 'redis', message: error.message });
    }
  }
}

/**
 * Starts a worker, which runs until it is drained. It reconnects when the connection to Redis is lost.
 *
 * @throws {FarmError} `farm/missing-package`, `farm/redis`, `farm/option`; `farm/store`, `farm/store-access` for a folder that
 * cannot be written, and a bucket that cannot be read
 */
export async function startFarmWorker(options: FarmWorkerOptions): Promise<FarmWorker> {
  const modules = options.modules ?? (await importQueueModules());
  await untilRedisAnswers(modules, options);
  await checkStore(options.store);
  await options.store.sweep();
  const keys = keysOf(options.name);
  const report = (error: Error) => options.onEvent?.({ type: 'redis', message: error.message });
  const redis = await connectRedis(modules, options.redis, true, report);
  const settings = { connection: redis, prefix: keys.prefix, skipVersionCheck: true };
  const queue = new modules.Queue(keys.queue, settings) as unknown as BullQueue<FarmJob>;
  queue.on('error', report);
  const worker = new FarmWorker(options, keys, redis, queue);
  worker.start((processor, more) => new modules.Worker(keys.queue, processor as never, { ...settings, ...more }));
  return worker;
}

import { randomBytes } from 'node:crypto';
import { rm } from 'node:fs/promises';
import { hostname } from 'node:os';
import { FarmError } from '../error';
import type { Destination, FarmJob, JobResult } from '../job';
import { jobOptions, type FarmQueueOptions } from '../queue/farm-queue';
import { keysOf, type QueueKeys } from '../queue/keys';
import {
  connectRedis,
  importQueueModules,
  type BullQueue,
  type BullWorker,
  type QueuedJob,
  type QueueModules,
  type RedisClient,
} from '../queue/redis';
import type { WorkerState } from '../queue/status';
import type { FarmStore } from '../store/store';
import { pauseAfter, verdictOn, type Tries } from './failure-policy';
import { RenderFailure, RendererProcess, type RenderEnd, type RendererProcessOptions } from './renderer-process';

/** Options of {@link startFarmWorker}. */
export interface FarmWorkerOptions extends FarmQueueOptions {
  readonly store: FarmStore;
  readonly renderer: RendererProcessOptions;
  /** For the status. Default: empty, the best GPU. */
  readonly gpu?: string | undefined;
  /**
   * Replaces the root of all destinations, where this machine sees the folder under another name. `false`: results stay
   * in the store, for machines that do not see the folder.
   */
  readonly outputRoot?: string | false | undefined;
  /**
   * Milliseconds for which a job belongs to the worker without a renewal of its lock; the job of a worker that is
   * killed goes to another one after this time. The worker's own process, which does not render, renews the lock.
   * Default: 30 s.
   */
  readonly lockMs?: number | undefined;
  /** Milliseconds that Redis may take to answer at the start. Afterwards commands wait for it. Default: 20 s. */
  readonly connectMs?: number | undefined;
  /** Milliseconds between heartbeats. Default: 5 s. */
  readonly beatMs?: number | undefined;
  /** Called with each event, for logs. */
  readonly onEvent?: ((event: WorkerEvent) => void) | undefined;
}

/** What a worker does. */
export type WorkerEvent =
  | { readonly type: 'begun'; readonly job: FarmJob }
  | { readonly type: 'done'; readonly job: FarmJob; readonly result: JobResult; readonly first: boolean }
  | { readonly type: 'failed'; readonly job: FarmJob; readonly failure: RenderFailure; readonly next: string }
  | { readonly type: 'given-back'; readonly job: FarmJob }
  | { readonly type: 'cancelled'; readonly job: FarmJob }
  | { readonly type: 'redis'; readonly message: string };

/** BullMQ does not move a job again if its processor throws an error with this name. */
class Moved extends Error {
  constructor(name: 'WaitingError' | 'DelayedError' | 'UnrecoverableError', message = name as string) {
    super(message);
    this.name = name;
  }
}

const LOCK_MS = 30_000;
const BEAT_MS = 5_000;
const CONNECT_MS = 20_000;
const CONNECT_PAUSE_MS = 500;
/** How many workers may end while they have a job: it does not cause the end of a machine that is switched off. */
const MAX_STALLS = 20;
const RECENT = 200;

/** The worker of one GPU: takes a job, renders it in a process of its own, stores the result, takes the next. */
export class FarmWorker {
  readonly id = `${hostname()}-${process.pid}-${randomBytes(3).toString('hex')}`;
  readonly #options: FarmWorkerOptions;
  readonly #keys: QueueKeys;
  readonly #redis: RedisClient;
  readonly #queue: BullQueue<FarmJob>;
  readonly #renderer: RendererProcess;
  #bull: BullWorker | undefined;
  #beat: NodeJS.Timeout | undefined;
  #beating = false;
  #current: { job: FarmJob; samples: number; of: number; cancelled: boolean } | undefined;
  #done = 0;
  #losses = 0;
  #draining = false;
  #pause: NodeJS.Timeout | undefined;

  /** See {@link startFarmWorker}. */
  constructor(options: FarmWorkerOptions, keys: QueueKeys, redis: RedisClient, queue: BullQueue<FarmJob>) {
    this.#options = options;
    this.#keys = keys;
    this.#redis = redis;
    this.#queue = queue;
    this.#renderer = new RendererProcess(options.renderer);
  }

  /** @param create Makes BullMQ's worker of a processor. */
  start(
    create: (processor: (job: QueuedJob<FarmJob>, token?: string) => Promise<unknown>, settings: object) => BullWorker,
  ): void {
    const { lockMs = LOCK_MS, beatMs = BEAT_MS, onEvent } = this.#options;
    this.#bull = create((job, token) => this.#process(job, token), {
      concurrency: 1,
      lockDuration: lockMs,
      stalledInterval: lockMs,
      maxStalledCount: MAX_STALLS,
    });
    this.#bull.on('error', (error: Error) => onEvent?.({ type: 'redis', message: error.message }));
    this.#beat = setInterval(() => void this.#heartbeat(), beatMs);
    void this.#heartbeat();
  }

  /** Whether it is rendering. */
  get busy(): boolean {
    return this.#current !== undefined;
  }

  /** Jobs that wait, are rendered or will be tried again, everywhere. */
  async left(): Promise<number> {
    const counts = await this.#queue.getJobCounts('waiting', 'active', 'delayed', 'paused', 'prioritized');
    return Object.values(counts).reduce((sum, count) => sum + count, 0);
  }

  /** Takes no more jobs, returns the current one to the queue with its samples so far, and ends. */
  async drain(): Promise<void> {
    this.#draining = true;
    clearTimeout(this.#pause);
    await this.#bull?.pause(true);
    if (this.#current) this.#renderer.stop();
    await this.#bull?.close();
    clearInterval(this.#beat);
    this.#renderer.kill();
    await this.#redis.call('HDEL', this.#keys.workers, this.id);
    await this.#queue.close().catch(() => undefined);
    this.#redis.disconnect();
  }

  async #process(queued: QueuedJob<FarmJob>, token: string | undefined): Promise<unknown> {
    const { store, onEvent } = this.#options;
    const job = queued.data;
    this.#current = { job, samples: 0, of: 0, cancelled: false };
    const start = performance.now();
    try {
      const there = await store.result(job.id);
      if (there) return await this.#finished(job, there, false);
      onEvent?.({ type: 'begun', job });
      const folder = await store.begin(job.id);
      let end: RenderEnd;
      try {
        end = await this.#rendered(job, folder);
        if (end.type === 'done') {
          const seconds = (performance.now() - start) / 1000;
          const first = await store.commit(
            folder,
            {
              id: job.id,
              label: job.label,
              seconds,
              worker: this.id,
              finished: new Date().toISOString(),
              ...(end.info === undefined ? {} : { info: end.info }),
            },
            end.files,
            end.hashes,
          );
          await store.dropCheckpoint(job.id);
          const result = await store.result(job.id);
          if (!result) throw new FarmError('farm/store', `The result of ${job.label} is not there.`);
          return await this.#finished(job, result, first);
        }
      } finally {
        await rm(folder, { recursive: true, force: true });
      }
      if (this.#current.cancelled) {
        await store.dropCheckpoint(job.id);
        onEvent?.({ type: 'cancelled', job });
        return 'cancelled';
      }
      await store.keepCheckpoint(job.id);
      onEvent?.({ type: 'given-back', job });
      await queued.moveToWait(token);
      throw new Moved('WaitingError');
    } catch (error) {
      if (error instanceof Moved) throw error;
      return await this.#failed(queued, token, failureOf(error));
    } finally {
      this.#current = undefined;
    }
  }

  async #rendered(job: FarmJob, folder: string): Promise<RenderEnd> {
    const { store } = this.#options;
    const end = this.#renderer.run(
      { type: 'job', job, store: store.address, folder, checkpoint: await store.checkpoint(job.id) },
      (samples, of) => {
        if (this.#current) Object.assign(this.#current, { samples, of });
      },
    );
    if (this.#draining) this.#renderer.stop();
    return end;
  }

  async #finished(job: FarmJob, result: JobResult, first: boolean): Promise<string> {
    const { store, outputRoot, onEvent } = this.#options;
    if (job.merge) {
      const parts = await Promise.all((job.merge.parts ?? []).map((id) => store.result(id)));
      // The last parts may end at the same time: the queue takes the merge once.
      if (parts.every((part) => part))
        await this.#queue.addBulk([{ name: job.merge.kind, data: job.merge, opts: jobOptions(job.merge.id) }]);
    } else if (outputRoot !== false) {
      const destinations = (await this.#redis.call('SMEMBERS', this.#keys.destinations(job.id))) as string[];
      for (const text of destinations) {
        const { root, paths } = JSON.parse(text) as Destination;
        await store.deliver(result, { root: outputRoot ?? root, paths });
      }
    }
    await this.#redis.call('DEL', this.#keys.tries(job.id), this.#keys.destinations(job.id));
    await this.#redis.call('LPUSH', this.#keys.recent, JSON.stringify(result));
    await this.#redis.call('LTRIM', this.#keys.recent, 0, RECENT - 1);
    await this.#redis.call('HINCRBY', this.#keys.totals, 'milliseconds', Math.round(1000 * result.seconds));
    await this.#redis.call('HINCRBY', this.#keys.totals, 'done', 1);
    this.#done++;
    this.#losses = 0;
    onEvent?.({ type: 'done', job, result, first });
    return 'done';
  }

  async #failed(queued: QueuedJob<FarmJob>, token: string | undefined, failure: RenderFailure): Promise<never> {
    const { store, onEvent } = this.#options;
    const job = queued.data;
    const { kind, code, message } = failure;
    // Another worker may continue from there; without them it begins again.
    await store.keepCheckpoint(job.id).catch(() => undefined);
    const tried = Number(await this.#redis.call('HINCRBY', this.#keys.tries(job.id), kind, 1));
    const verdict = verdictOn(kind, { [kind]: tried } satisfies Tries);
    await queued.log(`${new Date().toISOString()} ${this.id}: ${message} [${code}]`);
    for (const line of this.#renderer.printed.split('\n').slice(-40)) if (line.trim()) await queued.log(`  ${line}`);
    const next = verdict.type === 'dead' ? `given up: ${verdict.why}` : verdict.type;
    onEvent?.({ type: 'failed', job, failure, next });
    if (verdict.type === 'dead') throw new Moved('UnrecoverableError', `${message} [${code}] (${verdict.why})`);
    await this.#redis.call('HINCRBY', this.#keys.totals, `retry:${kind}`, 1);
    if (verdict.type === 'later') {
      await queued.moveToDelayed(Date.now() + verdict.delayMs, token);
      throw new Moved('DelayedError');
    }
    if (kind === 'gpu') await this.#pauseAfterLoss();
    await queued.moveToWait(token);
    throw new Moved('WaitingError');
  }

  /** After the loss of the GPU other workers take the job, and a new process requests the device. */
  async #pauseAfterLoss(): Promise<void> {
    this.#renderer.kill();
    await this.#bull?.pause(true);
    this.#pause = setTimeout(
      () => {
        if (!this.#draining) this.#bull?.resume();
      },
      pauseAfter(++this.#losses),
    );
  }

  async #heartbeat(): Promise<void> {
    // While Redis is away, one heartbeat waits for it.
    if (this.#beating) return;
    this.#beating = true;
    const { gpu = '', beatMs = BEAT_MS } = this.#options;
    const current = this.#current;
    const state: WorkerState = {
      id: this.id,
      host: hostname(),
      pid: process.pid,
      gpu,
      ...(current
        ? { job: { id: current.job.id, label: current.job.label, samples: current.samples, of: current.of } }
        : {}),
      done: this.#done,
      beat: Date.now(),
      beatMs,
    };
    try {
      await this.#redis.call('HSET', this.#keys.workers, this.id, JSON.stringify(state));
      if (current && Number(await this.#redis.call('SREM', this.#keys.cancelled, current.job.id)) === 1) {
        current.cancelled = true;
        this.#renderer.stop();
      }
    } catch {
      // The next heartbeat replaces it.
    } finally {
      this.#beating = false;
    }
  }
}

function failureOf(error: unknown): RenderFailure {
  if (error instanceof RenderFailure) return error;
  if (error instanceof FarmError) return new RenderFailure('output', error.code, error.message);
  const { message = String(error), code } = error as NodeJS.ErrnoException;
  // Calls of the file system.
  return new RenderFailure(typeof code === 'string' ? 'output' : 'other', 'farm/store', message);
}

/** A Redis that restarts takes a few seconds. @throws {FarmError} `farm/redis` for one that does not answer at all */
async function untilRedisAnswers(
  modules: QueueModules,
  { redis, connectMs = CONNECT_MS }: FarmWorkerOptions,
): Promise<void> {
  for (const end = Date.now() + connectMs; ; await new Promise((done) => setTimeout(done, CONNECT_PAUSE_MS))) {
    try {
      (await connectRedis(modules, redis, false)).disconnect();
      return;
    } catch (error) {
      if (!(error instanceof FarmError) || error.code !== 'farm/redis' || Date.now() >= end) throw error;
    }
  }
}

/**
 * Starts a worker, which runs until it is drained. It reconnects when the connection to Redis is lost.
 *
 * @throws {FarmError} `farm/missing-package`, `farm/redis`, `farm/option`
 */
export async function startFarmWorker(options: FarmWorkerOptions): Promise<FarmWorker> {
  const modules = options.modules ?? (await importQueueModules());
  await untilRedisAnswers(modules, options);
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

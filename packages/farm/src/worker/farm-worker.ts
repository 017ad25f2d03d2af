import { randomBytes } from 'node:crypto';
import { existsSync } from 'node:fs';
import { rm } from 'node:fs/promises';
import { hostname } from 'node:os';
import { FarmError } from '../error';
import type { Destination, FarmJob, JobResult } from '../job';
import { jobOptions, type FarmQueueOptions } from '../queue/farm-queue';
import type { QueueKeys } from '../queue/keys';
import type { BullQueue, BullWorker, QueuedJob, RedisClient } from '../queue/redis';
import type { WorkerState } from '../queue/status';
import type { FarmStore } from '../store/store';
import { pauseAfter, verdictOn, type Tries } from './failure-policy';
import { RenderFailure, RendererProcess, type RenderEnd, type RendererProcessOptions } from './renderer-process';

/** Options of `startFarmWorker()`. */
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
  /** Milliseconds that `drain()` waits for a Redis that does not answer, after its last answer. Default: 10 s. */
  readonly leaveMs?: number | undefined;
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
/** How many workers may end while they have a job: it does not cause the end of a machine that is switched off. */
const MAX_STALLS = 20;
const RECENT = 200;
/** How long a worker that ends waits for a Redis that does not answer. */
const LEAVE_MS = 10_000;
const LOOK_MS = 250;

const pause = (ms: number) => new Promise<void>((done) => setTimeout(done, ms));

/** The worker of one GPU: takes a job, renders it in a process of its own, stores the result, takes the next. */
export class FarmWorker {
  readonly id = `${hostname()}-${process.pid}-${randomBytes(3).toString('hex')}`;
  readonly #options: FarmWorkerOptions;
  readonly #keys: QueueKeys;
  readonly #redis: RedisClient;
  readonly #queue: BullQueue<FarmJob>;
  readonly #renderer: RendererProcess;
  /** Connections that BullMQ has made, which it cannot end while Redis is away. */
  readonly #waiting: RedisClient[] = [];
  #bull: BullWorker | undefined;
  #beat: NodeJS.Timeout | undefined;
  #beating = false;
  /** When Redis has answered last. */
  #answered = Date.now();
  /** Whether a job is rendered, or its files are stored, for which Redis is not needed. */
  #storing = false;
  #current:
    | { job: FarmJob; samples: number; of: number; resumed: number; cancelled: boolean; start: number }
    | undefined;
  #done = 0;
  #failures = 0;
  #draining = false;
  #pause: NodeJS.Timeout | undefined;

  /** See `startFarmWorker()`. */
  constructor(options: FarmWorkerOptions, keys: QueueKeys, redis: RedisClient, queue: BullQueue<FarmJob>) {
    this.#options = options;
    this.#keys = keys;
    this.#redis = redis;
    this.#queue = queue;
    const duplicate = redis.duplicate.bind(redis);
    redis.duplicate = (...given) => {
      const made = duplicate(...given);
      this.#waiting.push(made);
      return made;
    };
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

  /**
   * Takes no more jobs, returns the current one to the queue with its samples so far, and ends. If Redis does not answer
   * meanwhile, the worker ends without it (`leaveMs`): the samples are in the store, and the job
   * goes to another worker when the lock has expired.
   */
  async drain(): Promise<void> {
    this.#draining = true;
    clearTimeout(this.#pause);
    const { beatMs = BEAT_MS, leaveMs = LEAVE_MS, onEvent } = this.#options;
    const patience = Math.max(leaveMs, 2 * beatMs);
    const left = this.#leave().then(
      () => true,
      () => true,
    );
    while (!(await Promise.race([left, pause(LOOK_MS).then(() => false)]))) {
      if (this.#storing || Date.now() - this.#answered <= patience) continue;
      onEvent?.({
        type: 'redis',
        message: 'no answer; an unfinished job goes to another worker when its lock expires',
      });
      break;
    }
    clearInterval(this.#beat);
    this.#renderer.kill();
    for (const connection of [...this.#waiting, this.#redis]) connection.disconnect();
    // While Redis is away BullMQ does not come to the end of close(), and its timer would keep the process alive.
    void this.#bull?.lockManager?.close();
  }

  async #leave(): Promise<void> {
    await this.#bull?.pause(true);
    if (this.#current) this.#renderer.stop();
    await this.#bull?.close();
    clearInterval(this.#beat);
    await this.#redis.call('HDEL', this.#keys.workers, this.id);
    await this.#queue.close().catch(() => undefined);
  }

  async #process(queued: QueuedJob<FarmJob>, token: string | undefined): Promise<unknown> {
    const { store, onEvent } = this.#options;
    const job = queued.data;
    const start = performance.now();
    this.#current = { job, samples: 0, of: 0, resumed: 0, cancelled: false, start };
    this.#storing = true;
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
        this.#storing = false;
        await this.#redis.call('DEL', this.#keys.tries(job.id), this.#keys.destinations(job.id));
        onEvent?.({ type: 'cancelled', job });
        return 'cancelled';
      }
      await store.keepCheckpoint(job.id);
      this.#storing = false;
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
    const checkpoint = await store.checkpoint(job.id);
    let resumes = existsSync(checkpoint);
    const end = this.#renderer.run({ type: 'job', job, store: store.address, folder, checkpoint }, (samples, of) => {
      if (!this.#current) return;
      Object.assign(this.#current, { samples, of });
      // The first report of a job that continues counts the samples of earlier attempts.
      if (resumes && samples > 0) {
        this.#current.resumed = samples;
        resumes = false;
      }
    });
    if (this.#draining) this.#renderer.stop();
    return end;
  }

  async #finished(job: FarmJob, result: JobResult, first: boolean): Promise<string> {
    const { store, outputRoot, onEvent } = this.#options;
    this.#storing = false;
    if (job.merge) {
      const parts = await Promise.all((job.merge.parts ?? []).map((id) => store.result(id)));
      // The last parts may end at the same time: the queue takes the merge once.
      if (parts.every((part) => part))
        await this.#queue.addBulk([{ name: job.merge.kind, data: job.merge, opts: jobOptions(job.merge.id) }]);
    } else if (outputRoot !== false) {
      const destinations = (await this.#redis.call('SMEMBERS', this.#keys.destinations(job.id))) as string[];
      for (const text of destinations) {
        const { root, paths } = JSON.parse(text) as Destination;
        await store.deliver(result, { root: outputRoot ?? root, paths }).catch((error: unknown) => {
          // Of this job alone: other jobs have other destinations.
          throw new RenderFailure('files', 'farm/store', error instanceof Error ? error.message : String(error));
        });
      }
    }
    await this.#redis.call('DEL', this.#keys.tries(job.id), this.#keys.destinations(job.id));
    await this.#redis.call('LPUSH', this.#keys.recent, JSON.stringify(result));
    await this.#redis.call('LTRIM', this.#keys.recent, 0, RECENT - 1);
    await this.#redis.call('HINCRBY', this.#keys.totals, 'milliseconds', Math.round(1000 * result.seconds));
    await this.#redis.call('HINCRBY', this.#keys.totals, 'done', 1);
    this.#done++;
    this.#failures = 0;
    onEvent?.({ type: 'done', job, result, first });
    return 'done';
  }

  async #failed(queued: QueuedJob<FarmJob>, token: string | undefined, failure: RenderFailure): Promise<never> {
    const { store, onEvent } = this.#options;
    const job = queued.data;
    const { kind, code, message } = failure;
    // Another worker may continue from there; without them it begins again.
    await store.keepCheckpoint(job.id).catch(() => undefined);
    this.#storing = false;
    const tried = Number(await this.#redis.call('HINCRBY', this.#keys.tries(job.id), kind, 1));
    const verdict = verdictOn(kind, { [kind]: tried } satisfies Tries);
    await queued.log(`${new Date().toISOString()} ${this.id}: ${message} [${code}]`);
    for (const line of this.#renderer.printed.split('\n').slice(-40)) if (line.trim()) await queued.log(`  ${line}`);
    const next = verdict.type === 'dead' ? `given up: ${verdict.why}` : verdict.type;
    onEvent?.({ type: 'failed', job, failure, next });
    if (verdict.type === 'dead') throw new Moved('UnrecoverableError', `${message} [${code}] (${verdict.why})`);
    await this.#redis.call('HINCRBY', this.#keys.totals, `retry:${kind}`, 1);
    // Other workers take the jobs of one whose GPU or files fail, and a new process requests the device.
    if (kind === 'gpu') this.#renderer.kill();
    // For longer than the job waits, so that another one gets it.
    if (kind === 'gpu' || kind === 'output') await this.#rest(verdict.type === 'later' ? 2 * verdict.delayMs : 0);
    if (verdict.type === 'later') {
      await queued.moveToDelayed(Date.now() + verdict.delayMs, token);
      throw new Moved('DelayedError');
    }
    await queued.moveToWait(token);
    throw new Moved('WaitingError');
  }

  /** Takes no job for a while, the longer the more have failed one after another. @param minMs Milliseconds at least. */
  async #rest(minMs: number): Promise<void> {
    if (this.#draining) return;
    await this.#bull?.pause(true);
    clearTimeout(this.#pause);
    // It may have been drained meanwhile.
    if (this.#draining) return;
    this.#pause = setTimeout(
      () => {
        if (!this.#draining) this.#bull?.resume();
      },
      Math.max(minMs, pauseAfter(++this.#failures)),
    ).unref();
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
        ? {
            job: {
              id: current.job.id,
              label: current.job.label,
              samples: current.samples,
              of: current.of,
              resumed: current.resumed,
              seconds: (performance.now() - current.start) / 1000,
            },
          }
        : {}),
      done: this.#done,
      beat: Date.now(),
      beatMs,
    };
    try {
      await this.#redis.call('HSET', this.#keys.workers, this.id, JSON.stringify(state));
      this.#answered = Date.now();
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
  if (error instanceof FarmError)
    return new RenderFailure(error.code === 'farm/missing-file' ? 'files' : 'output', error.code, error.message);
  const { message = String(error), code } = error as NodeJS.ErrnoException;
  // Calls of the file system.
  return new RenderFailure(typeof code === 'string' ? 'output' : 'other', 'farm/store', message);
}

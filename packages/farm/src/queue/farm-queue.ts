import type { Destination, FarmJob, FarmRequest, JobResult } from '../job';
import type { FarmStore } from '../store/store';
import { keysOf, type QueueKeys } from './keys';
import {
  connectRedis,
  importQueueModules,
  guarded,
  type BullQueue,
  type QueuedJob,
  type QueueModules,
  type RedisClient,
} from './redis';
import { readStatus, type FarmStatus } from './status';

/** Options of {@link openFarmQueue} and of workers. */
export interface FarmQueueOptions {
  /** Such as `redis://127.0.0.1:6379`. */
  readonly redis: string;
  /** Several farms may share a Redis. Default: `glanz`. */
  readonly name?: string | undefined;
  /** Default: imported. */
  readonly modules?: QueueModules | undefined;
}

/** What became of submitted jobs. */
export interface Submission {
  /** Jobs that were handed to the queue; those that it has already are dropped by it. */
  readonly queued: number;
  /** Images whose results were in the store already. */
  readonly finished: number;
}

/** Jobs are handed to the queue in groups of this many. */
const GROUP = 500;
/** Lines of the log that a job keeps. */
const LOG_LINES = 400;

/** How a job stands in BullMQ. Attempts are counted by the worker, by the kind of failure. */
export const jobOptions = (id: string): Readonly<Record<string, unknown>> => ({
  jobId: id,
  attempts: 1,
  keepLogs: LOG_LINES,
  removeOnComplete: true,
  removeOnFail: false,
});

/** A queue of jobs on BullMQ and Redis, for code that submits jobs and reads their state. */
export class FarmQueue {
  readonly keys: QueueKeys;
  readonly #queue: BullQueue<FarmJob>;
  readonly #redis: RedisClient;

  /** See {@link openFarmQueue}. */
  constructor(queue: BullQueue<FarmJob>, redis: RedisClient, keys: QueueKeys) {
    this.#queue = queue;
    this.#redis = redis;
    this.keys = keys;
  }

  /**
   * Queues jobs, in groups, so that memory does not grow with their number. Results that the store has are copied to
   * their destinations at once and not queued; a job that the queue has already is not queued again.
   *
   * @param onGroup Called after each group, with the totals so far.
   */
  async submit(
    requests: Iterable<FarmRequest> | AsyncIterable<FarmRequest>,
    store: FarmStore,
    onGroup: (soFar: Submission) => void = () => undefined,
  ): Promise<Submission> {
    let soFar: Submission = { queued: 0, finished: 0 };
    let group: FarmRequest[] = [];
    const flush = async () => {
      if (group.length === 0) return;
      const { queued, finished } = await this.#submitGroup(group, store);
      soFar = { queued: soFar.queued + queued, finished: soFar.finished + finished };
      group = [];
      onGroup(soFar);
    };
    for await (const request of requests) {
      group.push(request);
      if (group.length >= GROUP) await flush();
    }
    await flush();
    return soFar;
  }

  async #submitGroup(group: readonly FarmRequest[], store: FarmStore): Promise<Submission> {
    const results = await Promise.all(group.map(({ job }) => store.result(job.id)));
    const open = group.filter((_, i) => !results[i]);
    // First where the files go, then the job: a worker that finishes it between the two finds the destination.
    await Promise.all(open.map(({ job, destination }) => this.#addDestination(destinationOwner(job), destination)));
    if (open.length > 0)
      await this.#queue.addBulk(open.map(({ job }) => ({ name: job.kind, data: job, opts: jobOptions(job.id) })));
    // And what was finished meanwhile is copied here.
    const late = await Promise.all(open.map(({ job }) => store.result(job.id)));
    const done = [...group.filter((_, i) => results[i]), ...open.filter((_, i) => late[i])];
    for (const { job, destination } of done) {
      const result = await store.result(job.id);
      if (result && destination && job.kind !== 'part') await store.deliver(result, destination);
    }
    await this.#redis.call('HINCRBY', this.keys.totals, 'submitted', open.length);
    return { queued: open.length, finished: group.length - open.length };
  }

  async #addDestination(id: string, destination: Destination | undefined): Promise<void> {
    if (destination) await this.#redis.call('SADD', this.keys.destinations(id), JSON.stringify(destination));
  }

  /** How far the farm is. */
  status(): Promise<FarmStatus> {
    return readStatus(this.#queue, this.#redis, this.keys);
  }

  /** Failed jobs that are not tried again, the newest first, with their logs. */
  async deadLetters(limit = 100): Promise<DeadLetter[]> {
    const failed = await this.#queue.getFailed(0, limit - 1);
    return Promise.all(
      failed.map(async (job) => ({
        id: String(job.id),
        label: job.data.label,
        reason: job.failedReason ?? '',
        failed: new Date(job.finishedOn ?? 0).toISOString(),
        log: (await this.#queue.getJobLogs(String(job.id))).logs,
      })),
    );
  }

  /**
   * Queues failed jobs again, as if they had never been tried.
   *
   * @param ids Default: all that have failed.
   * @returns How many.
   */
  async retry(ids?: readonly string[]): Promise<number> {
    let count = 0;
    for (const job of await this.#failed(ids)) {
      await this.#redis.call('DEL', this.keys.tries(String(job.id)));
      await job.retry('failed').then(
        () => count++,
        () => undefined,
      );
    }
    return count;
  }

  /**
   * Cancels jobs. Jobs that are being rendered stop within a heartbeat.
   *
   * @param ids Default: all.
   * @returns How many waiting, delayed or failed jobs were removed, and how many will stop.
   */
  async cancel(ids?: readonly string[]): Promise<{ readonly removed: number; readonly stopping: number }> {
    const active = ids ? ids : (await this.#queue.getActive(0, -1)).map(({ id }) => String(id));
    let removed = 0;
    let stopping = 0;
    if (!ids) {
      const states = ['waiting', 'delayed', 'paused', 'prioritized'];
      const [waiting, failed] = await Promise.all([this.#queue.getJobs(states, 0, -1), this.#failed()]);
      const found = waiting.filter((job) => job !== undefined);
      await this.#queue.drain(true);
      removed = found.length;
      for (const job of failed) await job.remove().then(() => removed++);
      // Not those that were submitted meanwhile.
      await this.#forget([...found, ...failed].map(({ data }) => data));
    }
    for (const id of active) {
      const job = await this.#queue.getJob(id);
      if (!job) continue;
      if ((await job.getState()) === 'active') {
        await this.#redis.call('SADD', this.keys.cancelled, id);
        stopping++;
        continue;
      }
      await job.remove();
      await this.#redis.call('DEL', this.keys.destinations(id), this.keys.tries(id));
      removed++;
    }
    return { removed, stopping };
  }

  /** Deletes what is kept of jobs beside BullMQ's keys: submitted again, they go to their new destinations alone. */
  async #forget(jobs: readonly FarmJob[]): Promise<void> {
    for (let i = 0; i < jobs.length; i += GROUP) {
      const group = jobs.slice(i, i + GROUP);
      const keys = group.flatMap((job) => [this.keys.destinations(destinationOwner(job)), this.keys.tries(job.id)]);
      await this.#redis.call('DEL', ...keys);
    }
  }

  async #failed(ids?: readonly string[]): Promise<QueuedJob<FarmJob>[]> {
    if (!ids) return this.#queue.getFailed(0, -1);
    const jobs = await Promise.all(ids.map((id) => this.#queue.getJob(id)));
    return jobs.filter((job): job is QueuedJob<FarmJob> => job?.failedReason !== undefined);
  }

  /** The results that were finished last, the newest first. */
  async recent(limit = 24): Promise<JobResult[]> {
    const rows = (await this.#redis.call('LRANGE', this.keys.recent, 0, limit - 1)) as string[];
    return rows.map((row) => JSON.parse(row) as JobResult);
  }

  /** Whether Redis may lose jobs as it is set up, as sentences; an empty list is good. */
  async warnings(): Promise<string[]> {
    const info = String(await this.#redis.call('INFO'));
    const of = (name: string) => new RegExp(`^${name}:(.*?)\\r?$`, 'm').exec(info)?.[1];
    return [
      ...(of('aof_enabled') === '0'
        ? ['Redis keeps no append-only file: jobs are lost when it ends (redis-server --appendonly yes).']
        : []),
      ...(of('maxmemory_policy') !== undefined && of('maxmemory_policy') !== 'noeviction'
        ? ['Redis may drop jobs when its memory is full (--maxmemory-policy noeviction).']
        : []),
    ];
  }

  /** Ends the connection. */
  async close(): Promise<void> {
    await this.#queue.close().catch(() => undefined);
    this.#redis.disconnect();
  }
}

/** A failed job that is not retried automatically. */
export interface DeadLetter {
  readonly id: string;
  readonly label: string;
  /** With its code in brackets. */
  readonly reason: string;
  /** ISO 8601. */
  readonly failed: string;
  /** The output of the renderer's processes, attempt by attempt. */
  readonly log: readonly string[];
}

/** Parts leave their files in the store; the merge has the destination. */
const destinationOwner = (job: FarmJob): string => job.merge?.id ?? job.id;

/**
 * Opens a queue.
 *
 * @throws {FarmError} `farm/missing-package`, `farm/redis`, `farm/option`
 */
export async function openFarmQueue({ redis, name, modules }: FarmQueueOptions): Promise<FarmQueue> {
  const loaded = modules ?? (await importQueueModules());
  const client = await connectRedis(loaded, redis, false);
  const keys = keysOf(name);
  const queue = new loaded.Queue(keys.queue, {
    connection: client,
    prefix: keys.prefix,
    skipVersionCheck: true,
  }) as unknown as BullQueue<FarmJob>;
  queue.on('error', () => undefined);
  return new FarmQueue(guarded(queue), guarded(client), keys);
}

import type { QueueKeys } from './keys';
import type { BullQueue, RedisClient } from './redis';

/** A worker by its last heartbeat. */
export interface WorkerState {
  readonly id: string;
  readonly host: string;
  readonly pid: number;
  /** As it was named; empty: the best one. */
  readonly gpu: string;
  /** The job that it is rendering. */
  readonly job?: {
    readonly id: string;
    readonly label: string;
    readonly samples: number;
    readonly of: number;
    /** Of the samples, those of earlier attempts. Default: none. */
    readonly resumed?: number;
    /** Since the job began. */
    readonly seconds?: number;
  };
  /** Jobs that it has finished. */
  readonly done: number;
  /** Milliseconds since 1970. */
  readonly beat: number;
  /** Milliseconds between its heartbeats. */
  readonly beatMs: number;
}

/** How far a farm is. */
export interface FarmStatus {
  readonly waiting: number;
  readonly active: number;
  /** Waiting for a later attempt. */
  readonly delayed: number;
  /** In the list of dead letters. */
  readonly failed: number;
  /** Jobs that workers have finished since the queue exists, parts included. */
  readonly done: number;
  /** Jobs that were handed to the queue since it exists. */
  readonly submitted: number;
  /** Attempts that were ended by each kind of failure, and taken up again. */
  readonly retries: Readonly<Record<string, number>>;
  /** Mean duration of a job, seconds; 0 before the first. */
  readonly secondsPerJob: number;
  /** Seconds until the queue is empty with the current number of workers; absent where it is not known. */
  readonly secondsLeft?: number;
  /** Those that live, by their heartbeats. */
  readonly workers: readonly WorkerState[];
}

/** Heartbeats that may be missing before a worker counts as gone. */
const MISSED = 4;
const FORGOTTEN_MS = 86_400_000;

/** Reads how far a farm is, in a number of calls that does not depend on the number of its jobs. */
export async function readStatus(
  queue: BullQueue<never> | BullQueue,
  redis: RedisClient,
  keys: QueueKeys,
  now = Date.now(),
): Promise<FarmStatus> {
  const [counts, totals, rows] = await Promise.all([
    queue.getJobCounts('waiting', 'active', 'delayed', 'failed', 'paused', 'prioritized'),
    redis.call('HGETALL', keys.totals) as Promise<string[]>,
    redis.call('HVALS', keys.workers) as Promise<string[]>,
  ]);
  const total = pairs(totals);
  const number = (name: string) => Number(total.get(name) ?? 0);
  const all = rows.map((row) => JSON.parse(row) as WorkerState);
  const workers = all.filter(({ beat, beatMs }) => now - beat <= MISSED * beatMs);
  const gone = all.filter(({ beat }) => now - beat > FORGOTTEN_MS).map(({ id }) => id);
  if (gone.length > 0) await redis.call('HDEL', keys.workers, ...gone);
  const waiting = (counts['waiting'] ?? 0) + (counts['paused'] ?? 0) + (counts['prioritized'] ?? 0);
  const { active = 0, delayed = 0, failed = 0 } = counts;
  const done = number('done');
  const secondsPerJob = done > 0 ? number('milliseconds') / 1000 / done : 0;
  const secondsLeft = timeLeft(workers, waiting + delayed, active, secondsPerJob);
  return {
    waiting,
    active,
    delayed,
    failed,
    done,
    submitted: number('submitted'),
    retries: Object.fromEntries(
      [...total].filter(([name]) => name.startsWith('retry:')).map(([name, count]) => [name.slice(6), Number(count)]),
    ),
    secondsPerJob,
    ...(secondsLeft === undefined ? {} : { secondsLeft }),
    workers: workers.sort((a, b) => (a.id < b.id ? -1 : 1)),
  };
}

/**
 * Seconds until the queue is empty: of the jobs that are rendered by their progress, of the others by the mean of all;
 * `undefined` where neither is known.
 */
function timeLeft(
  workers: readonly WorkerState[],
  waiting: number,
  active: number,
  secondsPerJob: number,
): number | undefined {
  if (waiting + active === 0) return 0;
  if (workers.length === 0) return undefined;
  const running = workers.flatMap(({ job }) => (job ? [job] : []));
  const left = running.map(({ samples, of, resumed = 0, seconds = 0 }) =>
    samples > resumed ? (seconds * (of - samples)) / (samples - resumed) : secondsPerJob,
  );
  if (secondsPerJob === 0 && (waiting > 0 || left.includes(0))) return undefined;
  const all = left.reduce((sum, one) => sum + one, waiting * secondsPerJob);
  return Math.max(all / workers.length, ...left);
}

/** A hash as RESP2 gives it, names and values in turn. RESP3 gives an object. */
function pairs(reply: readonly string[] | Readonly<Record<string, string>>): Map<string, string> {
  if (!Array.isArray(reply)) return new Map(Object.entries(reply as Record<string, string>));
  const map = new Map<string, string>();
  for (let i = 0; i + 1 < reply.length; i += 2) map.set(reply[i] as string, reply[i + 1] as string);
  return map;
}

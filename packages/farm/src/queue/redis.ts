import { FarmError } from '../error';

/** The part of an `ioredis` client that the farm calls. */
export interface RedisClient {
  /** Ends the connection at once. */
  disconnect(): void;
  on(event: 'error', listener: (error: Error) => void): unknown;
  call(command: string, ...args: readonly (string | number)[]): Promise<unknown>;
}

/** A job of BullMQ, as far as the farm uses it. */
export interface QueuedJob<T = unknown> {
  readonly id?: string | undefined;
  readonly data: T;
  readonly failedReason?: string | undefined;
  readonly finishedOn?: number | undefined;
  readonly stalledCounter?: number | undefined;
  log(row: string): Promise<number>;
  remove(): Promise<void>;
  retry(state?: 'failed'): Promise<void>;
  moveToWait(token?: string): Promise<number>;
  moveToDelayed(timestamp: number, token?: string): Promise<void>;
  getState(): Promise<string>;
}

/** A queue of BullMQ, as far as the farm uses it. */
export interface BullQueue<T = unknown> {
  addBulk(
    jobs: readonly { readonly name: string; readonly data: T; readonly opts: Readonly<Record<string, unknown>> }[],
  ): Promise<unknown>;
  getJob(id: string): Promise<QueuedJob<T> | undefined>;
  getFailed(start: number, end: number): Promise<QueuedJob<T>[]>;
  getJobCounts(...states: string[]): Promise<Readonly<Record<string, number>>>;
  getJobLogs(id: string): Promise<{ readonly logs: readonly string[] }>;
  getActive(start: number, end: number): Promise<QueuedJob<T>[]>;
  drain(delayed?: boolean): Promise<void>;
  close(): Promise<void>;
  on(event: 'error', listener: (error: Error) => void): unknown;
}

/** A worker of BullMQ, as far as the farm uses it. */
export interface BullWorker {
  run(): Promise<void>;
  pause(doNotWaitActive?: boolean): Promise<void>;
  resume(): unknown;
  close(force?: boolean): Promise<void>;
  on(event: string, listener: (...args: never[]) => void): unknown;
}

/** The two optional packages. A program that bundles them passes them itself. */
export interface QueueModules {
  readonly Redis: new (url: string, options: Readonly<Record<string, unknown>>) => RedisClient;
  readonly Queue: new (name: string, options: Readonly<Record<string, unknown>>) => BullQueue<never>;
  readonly Worker: new (
    name: string,
    processor: ((job: QueuedJob<never>, token?: string) => Promise<unknown>) | null,
    options: Readonly<Record<string, unknown>>,
  ) => BullWorker;
}

/** Imports `bullmq` and `ioredis`. @throws {FarmError} `farm/missing-package` */
export async function importQueueModules(): Promise<QueueModules> {
  try {
    const [{ Queue, Worker }, { Redis }] = await Promise.all([import('bullmq'), import('ioredis')]);
    return { Queue, Worker, Redis } as unknown as QueueModules;
  } catch (cause) {
    throw new FarmError(
      'farm/missing-package',
      'A queue on Redis needs two more packages: npm install bullmq ioredis. Without --redis the images are rendered on this machine.',
      { cause },
    );
  }
}

/** The address of a Redis without its password, for messages. */
export function shownAddress(url: string): string {
  try {
    const shown = new URL(url);
    if (shown.password) shown.password = '***';
    return shown.href;
  } catch {
    return 'the given address';
  }
}

/**
 * Connects to a Redis.
 *
 * @param patient Whether commands wait while Redis is away, as workers do; otherwise the first one fails.
 * @throws {FarmError} `farm/redis`
 */
export async function connectRedis(
  { Redis }: QueueModules,
  url: string,
  patient: boolean,
  onError: (error: Error) => void = () => undefined,
): Promise<RedisClient> {
  if (!/^(rediss?|unix):/.test(url))
    throw new FarmError('farm/option', `The address of Redis must be like redis://127.0.0.1:6379, not "${url}".`);
  const client = new Redis(url, {
    maxRetriesPerRequest: patient ? null : 0,
    connectTimeout: 5000,
    ...(patient ? { retryStrategy: (times: number) => Math.min(100 * times, 2000) } : { retryStrategy: () => null }),
  });
  let last: Error | undefined;
  client.on('error', (error) => {
    last = error;
    onError(error);
  });
  if (patient) return client;
  try {
    await client.call('PING');
  } catch (cause) {
    client.disconnect();
    throw new FarmError(
      'farm/redis',
      `Redis does not answer at ${shownAddress(url)}: ${last?.message || (last as NodeJS.ErrnoException | undefined)?.code || (cause as Error).message}.`,
      { cause },
    );
  }
  return client;
}

import { FarmError } from '../error';

/** The part of an `ioredis` client that the farm calls. */
export interface RedisClient {
  /** Ends the connection at once. */
  disconnect(): void;
  /** Another connection with the same options; BullMQ makes one for commands that wait. */
  duplicate(...options: readonly unknown[]): RedisClient;
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
  getJobs(states: string[], start: number, end: number): Promise<(QueuedJob<T> | undefined)[]>;
  drain(delayed?: boolean): Promise<void>;
  close(): Promise<void>;
  on(event: 'error', listener: (error: Error) => void): unknown;
}

/** A worker of BullMQ, as far as the farm uses it. */
export interface BullWorker {
  run(): Promise<void>;
  /** What extends the locks, on a timer. */
  readonly lockManager?: { close(): Promise<void> };
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

/** The address of a Redis without its password and its query, for messages. */
export const shownAddress = (url: string): string =>
  url
    .replace(/\?.*@.*$/s, '@')
    .replace(/^((?:\w+:\/\/)?[^/@:]*)[/:@].*@/s, '$1:***@')
    .replace(/\?.*$/s, '?***');

/** The number of the database that an address names. @throws {FarmError} `farm/option` */
function databaseOf(url: string): number {
  const wrong = () =>
    new FarmError(
      'farm/option',
      `The address of Redis must be like redis://127.0.0.1:6379, or redis://127.0.0.1:6379/2 for its database 2, not "${shownAddress(url)}".`,
    );
  // The client would read it, and this connection would then select another one.
  if (/[?&]db=/.test(url)) throw wrong();
  if (url.startsWith('unix:')) return 0;
  if (!/^rediss?:\/\//.test(url)) throw wrong();
  let path: string;
  try {
    path = new URL(url).pathname;
  } catch {
    throw wrong();
  }
  if (!/^\/?\d{0,5}$/.test(path)) throw wrong();
  return Number(path.slice(1));
}

/** An answer that stays the same however often Redis is asked: a wrong password, no such database. */
export const isRefusal = (error: unknown): boolean =>
  error instanceof Error && error.name === 'ReplyError' && !/^(LOADING|BUSY|MASTERDOWN|TRYAGAIN)\b/.test(error.message);

/** What an error of `ioredis` or BullMQ means: Redis is away or refuses, or something else, which stays as it is. */
function redisFailure(error: unknown): unknown {
  if (!(error instanceof Error) || error instanceof FarmError) return error;
  const { name, message } = error;
  if (name === 'ReplyError')
    return new FarmError('farm/redis', `Redis refuses a command: ${sentence(message)}`, { cause: error });
  if (name === 'MaxRetriesPerRequestError' || /^(Connection is closed|Stream isn't writeable)/.test(message))
    return new FarmError('farm/redis', 'Redis does not answer any more.', { cause: error });
  return error;
}

/** The same object, whose asynchronous methods reject with what {@link redisFailure} makes of their errors. */
export const guarded = <T extends object>(target: T): T =>
  new Proxy(target, {
    get(object, key) {
      const member: unknown = Reflect.get(object, key, object);
      if (typeof member !== 'function') return member;
      return (...args: readonly unknown[]) => {
        const result: unknown = member.apply(object, args);
        return result instanceof Promise
          ? result.catch((error: unknown) => {
              throw redisFailure(error);
            })
          : result;
      };
    },
  });

const sentence = (text: string) => `${text.trim().replace(/\.+$/, '')}.`;

/** Milliseconds for the first answer. */
const ANSWER_MS = 10_000;

/**
 * Connects to a Redis.
 *
 * @param patient Whether commands wait while Redis is away, as workers do; otherwise they fail, and those after its
 * return succeed.
 * @throws {FarmError} `farm/redis`, `farm/option`
 */
export async function connectRedis(
  { Redis }: QueueModules,
  url: string,
  patient: boolean,
  onError: (error: Error) => void = () => undefined,
): Promise<RedisClient> {
  const database = databaseOf(url);
  let connected = false;
  const client = new Redis(url, {
    maxRetriesPerRequest: patient ? null : 0,
    connectTimeout: 5000,
    retryStrategy: (times: number) => (patient || connected ? Math.min(100 * times, 2000) : null),
  });
  let last: Error | undefined;
  client.on('error', (error) => {
    last = error;
    onError(error);
  });
  if (patient) return client;
  let timeout: NodeJS.Timeout | undefined;
  const silence = new Promise<never>((_, fail) => {
    timeout = setTimeout(() => fail(new Error(`no reply within ${ANSWER_MS / 1000} s`)), ANSWER_MS);
  });
  try {
    await Promise.race([client.call('PING'), silence]);
    // The client goes on with database 0 where there is none of this number.
    await Promise.race([client.call('SELECT', database), silence]);
    connected = true;
  } catch (cause) {
    client.disconnect();
    const reason = last && !isRefusal(cause) ? last : (cause as NodeJS.ErrnoException);
    throw new FarmError(
      'farm/redis',
      `Redis ${isRefusal(reason) ? 'refuses the connection' : 'does not answer'} at ${shownAddress(url)}: ${sentence(reason.message || (reason as NodeJS.ErrnoException).code || 'no reason is given')}`,
      { cause: reason },
    );
  } finally {
    clearTimeout(timeout);
  }
  return client;
}

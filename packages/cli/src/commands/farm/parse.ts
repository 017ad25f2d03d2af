import { homedir } from 'node:os';
import { join } from 'node:path';
import type { StoreAddress } from '@glanz/farm';
import { usage, OPTIONS, parseOptionsOf, presentNames, type RenderValues, type ReportOptions } from '../../options';

/** What `glanz farm` takes beside the options of `glanz render`. */
const FARM_OPTIONS = {
  ...OPTIONS,
  redis: { type: 'string' },
  queue: { type: 'string' },
  store: { type: 'string' },
  's3-endpoint': { type: 'string' },
  'store-cache': { type: 'string' },
  split: { type: 'string' },
  lock: { type: 'string' },
  image: { type: 'string' },
  part: { type: 'string' },
  openjd: { type: 'string' },
  port: { type: 'string' },
  host: { type: 'string' },
  manifest: { type: 'string' },
  metrics: { type: 'boolean' },
  'older-than': { type: 'string' },
  'until-empty': { type: 'boolean' },
  all: { type: 'boolean' },
} as const;

/** What `glanz farm` can be followed by. */
export const FARM_ACTIONS = [
  'submit',
  'work',
  'status',
  'retry',
  'cancel',
  'task',
  'manifest',
  'serve',
  'clean',
  'renderer',
] as const;

type Action = (typeof FARM_ACTIONS)[number];

/** `glanz farm`. */
export interface FarmCommand extends ReportOptions {
  readonly kind: 'farm';
  readonly action: Action;
  /** A batch file, or the ids of jobs. */
  readonly args: readonly string[];
  readonly redis: string | undefined;
  readonly queue: string | undefined;
  /** Folders in it are relative to the working directory. */
  readonly store: StoreAddress;
  /** Maximum samples of a job. */
  readonly split: number | undefined;
  /** Seconds. */
  readonly lock: number | undefined;
  /** Numbers of images, from 0, or their names as `imageName` has them; absent: all. */
  readonly images: readonly (number | string)[] | undefined;
  /** Of images in parts: this one alone, without the merge. */
  readonly part: number | undefined;
  /** A template to write instead of queueing. */
  readonly openjd: string | undefined;
  readonly port: number;
  readonly host: string;
  readonly manifest: string | undefined;
  readonly metrics: boolean;
  /** Milliseconds; of `clean`. */
  readonly olderThan: number | undefined;
  readonly untilEmpty: boolean;
  readonly all: boolean;
  readonly outputRoot: string | undefined;
  readonly gpus: readonly string[];
  readonly values: RenderValues;
  readonly warnings: readonly string[];
}

/** Where the store is unless `--store` names another folder. */
export const DEFAULT_STORE = '.glanz-farm';
/** Where `glanz farm serve` listens. */
const DEFAULT_PORT = 4180;

const BATCH: readonly Action[] = ['submit', 'task', 'manifest'];
const REDIS: readonly Action[] = ['work', 'status', 'retry', 'cancel', 'serve'];

/**
 * Reads the arguments after `farm`.
 *
 * @param environment For `GLANZ_REDIS`, `AWS_ENDPOINT_URL_S3`, `AWS_ENDPOINT_URL` and `XDG_CACHE_HOME`.
 * @throws {CliError} `cli/usage`
 */
export function parseFarm(argv: readonly string[], environment: NodeJS.ProcessEnv = process.env): FarmCommand {
  const { values: given, positionals } = parseOptionsOf(argv, FARM_OPTIONS);
  const [action, ...args] = positionals;
  if (!FARM_ACTIONS.includes(action as Action))
    throw usage(
      `${action === undefined ? 'glanz farm needs an action' : `glanz farm has no action "${action}"`}. Known: ${FARM_ACTIONS.slice(0, -1).join(', ')}. See glanz help farm.`,
    );
  const is = action as Action;
  const warnings: string[] = [];
  const {
    redis: address,
    queue,
    store,
    's3-endpoint': endpoint,
    'store-cache': cache,
    split,
    lock,
    image,
    part,
    openjd,
    port,
    host,
    manifest,
    'older-than': olderThan,
    ...rest
  } = given;
  const values = presentNames(rest as RenderValues, (text) => warnings.push(text));
  const redis = address ?? (environment.GLANZ_REDIS || undefined);
  if (BATCH.includes(is) && args.length !== 1)
    throw usage(`glanz farm ${is} takes one batch file: glanz farm ${is} batch.json. See glanz help farm.`);
  if (REDIS.includes(is) && redis === undefined)
    throw usage(`glanz farm ${is} needs --redis redis://HOST:6379, or GLANZ_REDIS in the environment.`);
  if ((is === 'work' || is === 'status' || is === 'serve' || is === 'clean') && args.length > 0)
    throw usage(`glanz farm ${is} takes no files: unexpected argument "${args[0]}".`);
  if ((is === 'retry' || is === 'cancel') && args.length > 0 === (given.all ?? false))
    throw usage(`glanz farm ${is} takes ids of jobs, which glanz farm status lists, or --all.`);
  if (is === 'clean' && olderThan === undefined)
    throw usage('glanz farm clean needs --older-than, such as 30d or 12h: what was not used for so long is deleted.');
  if (is === 'manifest' && manifest === undefined)
    throw usage('glanz farm manifest needs --manifest FILE, where to write it.');
  return {
    kind: 'farm',
    action: is,
    args,
    json: given.json ?? false,
    quiet: given.quiet ?? false,
    redis,
    queue,
    store: storeOf(store, endpoint, cache, environment),
    split: whole('split', split, 16, 2147483647),
    lock: whole('lock', lock, 1, 3600),
    images: image === undefined ? undefined : imagesOf(image),
    part: whole('part', part, 0, 1e6),
    openjd,
    port: whole('port', port, 0, 65535) ?? DEFAULT_PORT,
    host: host ?? '127.0.0.1',
    manifest,
    metrics: given.metrics ?? false,
    olderThan: ageOf(olderThan),
    untilEmpty: given['until-empty'] ?? false,
    all: given.all ?? false,
    outputRoot: given['output-root'],
    gpus: given.gpu ?? [],
    values,
    warnings,
  };
}

/** A folder, or a bucket with its server and a folder for what is downloaded. */
function storeOf(
  url = join('.', DEFAULT_STORE),
  endpoint: string | undefined,
  cache: string | undefined,
  { AWS_ENDPOINT_URL_S3, AWS_ENDPOINT_URL, XDG_CACHE_HOME }: NodeJS.ProcessEnv,
): StoreAddress {
  if (!/^s3:/i.test(url)) {
    const [name] = Object.entries({ 's3-endpoint': endpoint, 'store-cache': cache }).find(([, value]) => value) ?? [];
    if (name !== undefined) throw usage(`--${name} is for a store in a bucket: --store s3://bucket/prefix.`);
    return { url };
  }
  return {
    url,
    endpoint: endpoint ?? (AWS_ENDPOINT_URL_S3 || AWS_ENDPOINT_URL || undefined),
    cache: cache ?? join(XDG_CACHE_HOME || join(homedir(), '.cache'), 'glanz', 'farm'),
  };
}

function whole(name: string, text: string | undefined, min: number, max: number): number | undefined {
  if (text === undefined) return undefined;
  const value = text.trim() === '' ? NaN : Number(text);
  if (!Number.isInteger(value) || value < min || value > max)
    throw usage(`--${name} must be a whole number from ${min} to ${max}, not "${text}".`);
  return value;
}

/** `30d`, `12h`, `90m`, in milliseconds. */
function ageOf(text: string | undefined): number | undefined {
  if (text === undefined) return undefined;
  const [, number, unit] = /^(\d{1,6})([dhm])$/.exec(text.trim()) ?? [];
  if (number === undefined)
    throw usage(`--older-than must be days, hours or minutes, such as 30d, 12h or 90m, not "${text}".`);
  return Number(number) * { d: 86_400_000, h: 3_600_000, m: 60_000 }[unit as 'd' | 'h' | 'm'];
}

/** `3`, `0,4`, `10-19`; `red/front`. */
function imagesOf(text: string): (number | string)[] {
  const out: (number | string)[] = [];
  for (const part of text.split(',')) {
    if (part.includes('/')) {
      out.push(part.trim());
      continue;
    }
    const [, from, to = from] = /^\s*(\d{1,9})(?:-(\d{1,9}))?\s*$/.exec(part) ?? [];
    if (from === undefined || Number(to) < Number(from) || Number(to) - Number(from) > 1e6)
      throw usage(
        `--image must be numbers from 0, such as 3 or 0,4 or 10-19, or names such as red/front, not "${text}".`,
      );
    for (let i = Number(from); i <= Number(to); i++) out.push(i);
  }
  return out;
}

import type { RenderFailure } from './renderer-process';

/** How often a job has failed so far, by kind. */
export type Tries = Readonly<Partial<Record<RenderFailure['kind'], number>>>;

/** What becomes of a job that has failed. */
export type Verdict =
  /** To the next worker, at once. */
  | { readonly type: 'elsewhere' }
  | { readonly type: 'later'; readonly delayMs: number }
  /** To the list of dead letters. */
  | { readonly type: 'dead'; readonly why: string };

/** Attempts by kind of failure. Input that is wrong once is wrong always. */
export const MAX_TRIES: Readonly<Record<RenderFailure['kind'], number>> = {
  gpu: 5,
  input: 1,
  output: 8,
  files: 8,
  crash: 3,
  other: 3,
};

const FIRST_DELAY_MS = 1000;
const MAX_DELAY_MS = 300_000;

const NAMES: Readonly<Record<RenderFailure['kind'], string>> = {
  gpu: 'it lost its GPU',
  input: 'its input is wrong',
  output: 'its files could not be written',
  files: 'its own files failed',
  crash: 'it ended its process',
  other: 'it failed',
};

/**
 * Decides what becomes of a job that has failed.
 *
 * @param tries This failure included.
 */
export function verdictOn(kind: RenderFailure['kind'], tries: Tries): Verdict {
  const count = tries[kind] ?? 1;
  if (count >= MAX_TRIES[kind]) return { type: 'dead', why: count > 1 ? `${NAMES[kind]} ${count} times` : NAMES[kind] };
  if (kind === 'gpu' || kind === 'crash') return { type: 'elsewhere' };
  return { type: 'later', delayMs: Math.min(FIRST_DELAY_MS * 2 ** (count - 1), MAX_DELAY_MS) };
}

/**
 * How long a worker takes no job after it has lost its GPU, or could not write its files.
 *
 * @param failures Without a finished job in between.
 */
export const pauseAfter = (failures: number): number => Math.min(1000 * 2 ** (failures - 1), 60_000);

import type { Job } from './here';
import type { WorkerLine } from './line';

/**
 * Where there is no more to build than so many triangles, one worker does it all: others would compile their code anew
 * for it.
 */
const SHARE = 48_000;

/** A place in the pool for one worker after another. */
export interface Seat {
  line: WorkerLine | undefined;
  ready: boolean;
  /** Waits for a worker to report. */
  timer: ReturnType<typeof setTimeout> | undefined;
  /** Builds that were sent and not answered, abandoned ones too. */
  readonly jobs: Map<number, Job>;
  /** Their triangles. */
  load: number;
  warmth: Warmth;
}

/** How far a worker is with warming up, where that is asked for. */
type Warmth = (typeof WARMTHS)[number];
const WARMTHS = ['warm', 'warming', 'cold'] as const;

/**
 * The workers that are there and worth asking, the warm ones first.
 *
 * @param triangles Of all builds that they share.
 */
export const seatsWorth = (seats: Iterable<Seat>, triangles: number): Seat[] =>
  [...seats]
    .filter(({ ready }) => ready)
    .sort((a, b) => WARMTHS.indexOf(a.warmth) - WARMTHS.indexOf(b.warmth))
    .slice(0, Math.max(1, Math.ceil(triangles / SHARE)));

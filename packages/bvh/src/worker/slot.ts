import type { Job } from './calling-thread';
import type { WorkerConnection } from './connection';

/**
 * Up to this many triangles, one worker does all builds: another one would have to compile the code again first.
 */
const TRIANGLES_PER_WORKER = 48_000;

/** A slot of the pool: it holds one worker, and its replacement if that ends. */
export interface WorkerSlot {
  connection: WorkerConnection | undefined;
  ready: boolean;
  /** Limits the start of a worker. */
  timer: ReturnType<typeof setTimeout> | undefined;
  /** Builds that were sent and not answered, aborted ones too. */
  readonly jobs: Map<number, Job>;
  /** Their triangles. */
  load: number;
  warmth: Warmth;
}

/** State of a worker's warm-up. */
type Warmth = (typeof WARMTHS)[number];
const WARMTHS = ['warm', 'warming', 'cold'] as const;

/**
 * The slots whose workers are ready and worth using, warm ones first.
 *
 * @param triangles Total of all builds that they share.
 */
export const usableSlots = (slots: Iterable<WorkerSlot>, triangles: number): WorkerSlot[] =>
  [...slots]
    .filter(({ ready }) => ready)
    .sort((a, b) => WARMTHS.indexOf(a.warmth) - WARMTHS.indexOf(b.warmth))
    .slice(0, Math.max(1, Math.ceil(triangles / TRIANGLES_PER_WORKER)));

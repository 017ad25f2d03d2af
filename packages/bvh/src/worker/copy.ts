import { yieldToEventLoop } from '../async';

type Numbers = Float32Array | Uint32Array | Uint16Array;

/** An array and the room for what it holds. */
export interface Copy {
  readonly from: Numbers;
  readonly to: Numbers;
}

/** Entries that are copied between two looks at the clock: well under a millisecond, fresh pages included. */
const PIECE = 1 << 17;

/** The thread is handed back after so many milliseconds. */
const SLICE_MS = 4;

/** So few entries are copied at once. */
const LITTLE = 1 << 18;

/** Room for a copy in memory of its own. */
export const roomFor = <T extends Numbers>(array: T): T =>
  new (array.constructor as new (length: number) => T)(array.length);

/**
 * Copies arrays: at once if they are small, otherwise with the thread handed back in between, for 20 MB take ten
 * milliseconds.
 *
 * @param told Hears after each piece how many entries are there, of all arrays one after the other.
 * @returns A promise where it takes longer than this call.
 * @throws {TypeError} for arrays that were given away.
 */
export function copyAll(copies: readonly Copy[], told?: (entries: number) => void): Promise<void> | undefined {
  const steps = pieces(copies, told);
  if (copies.reduce((sum, { from }) => sum + from.length, 0) > LITTLE) return inTurns(steps);
  while (!steps.next().done);
  return undefined;
}

function* pieces(copies: readonly Copy[], told?: (entries: number) => void): Generator<void> {
  let before = 0;
  for (const { from, to } of copies) {
    let at = 0;
    // Empty arrays too: those that were given away are empty, and must not pass.
    do {
      to.set(from.subarray(at, at + PIECE), at);
      at += PIECE;
      told?.(before + Math.min(at, to.length));
      yield;
    } while (at < to.length);
    before += to.length;
  }
}

async function inTurns(steps: Generator<void>): Promise<void> {
  let until = performance.now() + SLICE_MS;
  while (!steps.next().done) {
    if (performance.now() < until) continue;
    await yieldToEventLoop();
    until = performance.now() + SLICE_MS;
  }
}

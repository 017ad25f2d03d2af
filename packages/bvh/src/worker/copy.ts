import { yieldToEventLoop } from '../async';

type Numbers = Float32Array | Uint32Array | Uint16Array;

/** An array and the destination of its copy. */
export interface Copy {
  readonly from: Numbers;
  readonly to: Numbers;
}

/** Entries copied between two checks of the clock: well under a millisecond, page faults included. */
const PIECE = 1 << 17;

/** Milliseconds of copying after which the thread yields. */
const SLICE_MS = 4;

/** Up to this many entries are copied without yielding. */
const COPY_AT_ONCE = 1 << 18;

/** Allocates the destination of a copy. */
export const allocateLike = <T extends Numbers>(array: T): T =>
  new (array.constructor as new (length: number) => T)(array.length);

/**
 * Copies arrays: at once if they are small, otherwise yielding to the event loop in between, as 20 MB take ten
 * milliseconds.
 *
 * @param onCopied Called after each piece with the number of entries copied so far, of all arrays in order.
 * @returns A promise where it takes longer than this call.
 * @throws {TypeError} for detached arrays.
 */
export function copyAll(copies: readonly Copy[], onCopied?: (entries: number) => void): Promise<void> | undefined {
  const steps = pieces(copies, onCopied);
  if (copies.reduce((sum, { from }) => sum + from.length, 0) > COPY_AT_ONCE) return inSlices(steps);
  while (!steps.next().done);
  return undefined;
}

function* pieces(copies: readonly Copy[], onCopied?: (entries: number) => void): Generator<void> {
  let before = 0;
  for (const { from, to } of copies) {
    let at = 0;
    // Empty arrays too: detached ones are empty, and must throw.
    do {
      to.set(from.subarray(at, at + PIECE), at);
      at += PIECE;
      onCopied?.(before + Math.min(at, to.length));
      yield;
    } while (at < to.length);
    before += to.length;
  }
}

async function inSlices(steps: Generator<void>): Promise<void> {
  let until = performance.now() + SLICE_MS;
  while (!steps.next().done) {
    if (performance.now() < until) continue;
    await yieldToEventLoop();
    until = performance.now() + SLICE_MS;
  }
}

/**
 * Long work that stops once in a while: a generator that yields every millisecond or so and returns what it has made.
 */
export type Steps<T> = Generator<void, T>;

/** Items that are looked at between two stops: well under a millisecond where each costs a few operations. */
export const STEP = 1 << 16;

/** Does all of it at once. */
export function finish<T>(steps: Steps<T>): T {
  let step = steps.next();
  while (!step.done) step = steps.next();
  return step.value;
}

/** What {@link inSlices} may be told. */
export interface SliceOptions {
  /** Gives up: the promise rejects with the signal's reason after the slice at work. */
  readonly signal?: AbortSignal | undefined;
  /** The thread is handed back after so many milliseconds. Default 6. */
  readonly sliceMs?: number;
}

/** Lets other tasks of the event loop run. Uses a timer, which costs milliseconds, only where nothing faster exists. */
export function yieldToEventLoop(): Promise<void> {
  const { scheduler, setImmediate } = globalThis as {
    scheduler?: { yield?: () => Promise<void> };
    setImmediate?: (done: () => void) => void;
  };
  return scheduler?.yield?.() ?? new Promise((resolve) => void (setImmediate ?? setTimeout)(resolve));
}

/**
 * Does long work on the calling thread in slices, with everything else that waits in between, so that a page stays
 * responsive.
 *
 * @param steps What a function named `…Steps` returns: {@link sceneBoundsSteps}, {@link frameCameraSteps},
 * {@link validationSteps}.
 * @returns What the steps return.
 * @throws what the steps throw; the signal's reason when aborted.
 * @example
 * const camera = await inSlices(frameCameraSteps(scene, { aspect: 16 / 9 }), { signal });
 */
export async function inSlices<T>(steps: Steps<T>, { signal, sliceMs = 6 }: SliceOptions = {}): Promise<T> {
  signal?.throwIfAborted();
  let until = performance.now() + sliceMs;
  for (;;) {
    const step = steps.next();
    if (step.done) return step.value;
    if (performance.now() < until) continue;
    await yieldToEventLoop();
    signal?.throwIfAborted();
    until = performance.now() + sliceMs;
  }
}

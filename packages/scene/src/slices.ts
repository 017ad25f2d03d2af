/**
 * Long work in steps: a generator that yields about every millisecond and returns its result.
 */
export type Steps<T> = Generator<void, T>;

/** Items visited between two yields: well under a millisecond where each costs a few operations. */
export const STEP = 1 << 16;

/** Runs all steps without a pause and returns the result. */
export function finish<T>(steps: Steps<T>): T {
  let step = steps.next();
  while (!step.done) step = steps.next();
  return step.value;
}

/** Options for {@link inSlices}. */
export interface SliceOptions {
  /** Cancels: the promise rejects with the signal's reason after the current slice. */
  readonly signal?: AbortSignal | undefined;
  /** Length of a slice, milliseconds. Default 6. */
  readonly sliceMs?: number;
}

/** Yields to the event loop. Uses a timer, which costs milliseconds, only where there is no faster way. */
export function yieldToEventLoop(): Promise<void> {
  const { scheduler, setImmediate } = globalThis as {
    scheduler?: { yield?: () => Promise<void> };
    setImmediate?: (done: () => void) => void;
  };
  return scheduler?.yield?.() ?? new Promise((resolve) => void (setImmediate ?? setTimeout)(resolve));
}

/**
 * Runs long work on the calling thread in slices and yields to the event loop in between, so that a page stays
 * responsive.
 *
 * @param steps What a function named `…Steps` returns: {@link sceneBoundsSteps}, {@link frameCameraSteps},
 * {@link checkSceneSteps}, {@link validationSteps}.
 * @returns What the steps return.
 * @throws What the steps throw, or the signal's reason when aborted.
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

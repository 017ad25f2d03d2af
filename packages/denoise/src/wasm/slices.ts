/** Milliseconds between two returns to the event loop. */
const SLICE_MS = 12;

/** Lets other tasks of the event loop run. Uses a timer, which costs milliseconds, only where there is no faster way. */
function yieldToEventLoop(): Promise<void> {
  const { scheduler, setImmediate } = globalThis as {
    scheduler?: { yield?: () => Promise<void> };
    setImmediate?: (done: () => void) => void;
  };
  return scheduler?.yield?.() ?? new Promise((resolve) => void (setImmediate ?? setTimeout)(resolve));
}

/**
 * Cuts work on the calling thread into slices.
 *
 * @param between Called after each slice; what it throws ends the work.
 * @returns A function to call after each step: `undefined` until a slice is over, then what to wait for.
 */
export function slices(between: () => void): () => Promise<void> | undefined {
  let until = performance.now() + SLICE_MS;
  return () => {
    if (performance.now() < until) return undefined;
    return yieldToEventLoop().then(() => {
      between();
      until = performance.now() + SLICE_MS;
    });
  };
}

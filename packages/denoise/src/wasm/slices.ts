/** Milliseconds between two returns to the event loop. */
const SLICE_MS = 6;

/**
 * Lets other tasks of the event loop run, all that wait: a timer would cost milliseconds, and `scheduler.yield()` comes
 * back ahead of messages and timers, for seconds.
 */
function yieldToEventLoop(): Promise<void> {
  const { setImmediate } = globalThis as { setImmediate?: (done: () => void) => void };
  return new Promise((resolve) => {
    if (setImmediate) return setImmediate(resolve);
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      resolve();
    };
    port2.postMessage(0);
  });
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

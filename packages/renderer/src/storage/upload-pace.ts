import { yieldToEventLoop } from '@glanz/scene';

/** So much is written between two marks in the queue; what two of them enclose may wait for the GPU's process. */
const WINDOW_BYTES = 1 << 20;

/** Milliseconds of writing between two yields to the event loop. */
const FILL_MS = 4;

/**
 * Makes a function to await after bytes were written to the GPU. It yields to the event loop every few milliseconds, and
 * waits for the GPU's process now and then: where it is another one than the page's, what is written waits in a queue
 * between them, and the page's thread would stand still once that is full. It waits for what was written before the last
 * window, so that the GPU has work meanwhile.
 */
export function uploadPace(device: GPUDevice): (bytes: number) => Promise<void> {
  let written = 0;
  let last = performance.now();
  let before: Promise<unknown> | undefined;
  return async (bytes) => {
    written += bytes;
    if (written >= WINDOW_BYTES) {
      written = 0;
      const reached = device.queue.onSubmittedWorkDone();
      // A lost device is reported by the next wait, or by `check` after the stage.
      reached.catch(() => {});
      const waited = before;
      before = reached;
      await waited;
    }
    if (performance.now() - last < FILL_MS) return;
    await yieldToEventLoop();
    last = performance.now();
  };
}

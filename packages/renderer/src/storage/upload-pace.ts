import { yieldToEventLoop } from '@glanz/scene';

/** So much may wait for the GPU's process. */
const QUEUE_BYTES = 2 << 20;

/** Milliseconds of writing between two yields to the event loop. */
const FILL_MS = 4;

/**
 * Makes a function to await after bytes were written to the GPU. It yields to the event loop every few milliseconds, and
 * waits for the GPU's process now and then: where it is another one than the page's, what is written waits in a queue
 * between them, and the page's thread would stand still once that is full.
 */
export function uploadPace(device: GPUDevice): (bytes: number) => Promise<void> {
  let waiting = 0;
  let last = performance.now();
  return async (bytes) => {
    waiting += bytes;
    if (waiting >= QUEUE_BYTES) {
      waiting = 0;
      await device.queue.onSubmittedWorkDone();
    } else if (performance.now() - last >= FILL_MS) await yieldToEventLoop();
    else return;
    last = performance.now();
  };
}

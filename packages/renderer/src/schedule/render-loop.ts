import type { Batch, Scheduler } from './scheduler';

/** What a render loop works with. */
export interface RenderLoop {
  readonly scheduler: Scheduler;
  /** Samples per pixel to reach. */
  readonly target: number;
  readonly queue: GPUQueue;
  /** Submits a batch. The promise rejects if the GPU refuses it. */
  readonly submit: (batch: Batch) => Promise<void>;
  /** The number of paths in memory; allocates more where a batch of so many could use them. */
  readonly room: (paths: number) => number;
  /** Settles when batches may be submitted again; `undefined`: now. */
  readonly ready: () => Promise<void> | undefined;
  /** Whether the image is still the one the loop began with, and wanted. */
  readonly current: () => boolean;
  /** Throws if the device failed. */
  readonly check: () => void;
}

/** Submissions on their way at once: one runs, one waits, so that the GPU never does. */
const IN_FLIGHT = 2;
/**
 * Batches that take so many times the budget go one by one: where the GPU cannot keep to it, the pause between two of
 * them is short compared with the time that an interruption would wait for a second one.
 */
const LATE = 1.25;
/** Milliseconds: reports of the GPU that are closer than that came in one task, of which nothing can be learned. */
const TOGETHER = 0.25;

/**
 * Submits batches until the target is reached, measures them, and gives the number of samples after each that is
 * complete.
 */
export async function* renderLoop(loop: RenderLoop): AsyncGenerator<number, void, undefined> {
  const { scheduler, target, queue, submit, room, ready, current, check } = loop;
  let reported = scheduler.samples;
  let lastDone = performance.now();
  let last = 0;
  // When what was submitted before the first batch was done, which it waits for.
  let idle = 0;
  queue.onSubmittedWorkDone().then(
    () => (idle = performance.now()),
    () => {},
  );
  let before: { readonly paths: number; readonly milliseconds: number; readonly first: boolean } | undefined;
  const inFlight: { batch: Batch; submitted: number; after: number; done: Promise<number>; verified: Promise<void> }[] =
    [];
  for (;;) {
    while (inFlight.length < (last > LATE * scheduler.budget ? 1 : IN_FLIGHT) && current()) {
      const wait = ready();
      if (wait) {
        await wait;
        continue;
      }
      const batch = scheduler.next(target, room(scheduler.paths));
      if (!batch) break;
      const submitted = performance.now();
      const verified = submit(batch);
      inFlight.push({
        batch,
        submitted,
        after: scheduler.samples,
        verified,
        done: queue.onSubmittedWorkDone().then(() => {
          const now = performance.now();
          return now - Math.max(submitted, lastDone, now - idle > TOGETHER ? idle : 0);
        }),
      });
    }
    const oldest = inFlight.shift();
    if (!oldest) return;
    const milliseconds = await oldest.done;
    const waited = oldest.submitted < lastDone;
    lastDone = performance.now();
    check();
    await oldest.verified;
    const paths = oldest.batch.pixelCount * oldest.batch.sampleCount;
    // The report of the batch before may have come late, which would make this one look short and the next one far too
    // long: of batches that follow each other, the time of two counts. But the first one includes one-time costs, and
    // counts by itself unless both reports came together.
    const shared =
      waited && before && (!before.first || milliseconds < TOGETHER)
        ? ((before.milliseconds + milliseconds) * paths) / (before.paths + paths)
        : milliseconds;
    before = { paths, milliseconds, first: !before };
    scheduler.measured(oldest.batch, shared);
    last = shared;
    if (!current()) {
      await Promise.all(inFlight.map(({ done }) => done));
      return;
    }
    if (oldest.after > reported) {
      reported = oldest.after;
      yield reported;
    }
  }
}

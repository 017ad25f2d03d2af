import { yieldToEventLoop } from '../async';
import { blasSteps, type Blas, type BlasOptions } from '../blas';
import type { TriangleMesh } from '../layout';

/** Milliseconds of building after which the thread yields; one more step can follow. */
const SLICE_MS = 6;

/** A pending build. */
export interface Job {
  readonly id: number;
  readonly mesh: TriangleMesh;
  readonly options: BlasOptions;
  readonly transfer: boolean;
  readonly triangles: number;
  readonly progress: (done: number) => void;
  /** Ends the promise. Calls after the first do nothing. */
  readonly settle: (result: Blas | { readonly error: unknown }) => void;
  settled: boolean;
}

/** Runs queued builds on the calling thread, in slices. */
export class CallingThreadBuilds {
  #building = false;

  /** Builds until the queue is empty; does nothing if it is running already. */
  async run(queue: Job[]): Promise<void> {
    if (this.#building) return;
    this.#building = true;
    let until = -Infinity;
    while (queue.length > 0) {
      if (performance.now() > until) {
        await yieldToEventLoop();
        until = performance.now() + SLICE_MS;
        continue;
      }
      const job = queue.shift() as Job;
      try {
        job.progress(0);
        const steps = blasSteps(job.mesh, job.options);
        // A job that is settled otherwise, for example by an abort, ends its build.
        for (let step = steps.next(); !job.settled; step = steps.next()) {
          if (step.done) {
            job.progress(1);
            job.settle(step.value);
          } else if (performance.now() > until) {
            job.progress(step.value);
            await yieldToEventLoop();
            until = performance.now() + SLICE_MS;
          }
        }
      } catch (error) {
        job.settle({ error });
      }
    }
    // In the same task as the last build, so that the next caller never finds this set while nothing runs.
    this.#building = false;
  }
}

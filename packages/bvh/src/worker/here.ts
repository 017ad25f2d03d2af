import { yieldToEventLoop } from '../async';
import { blasSteps, type Blas, type BlasOptions } from '../blas';
import type { TriangleMesh } from '../layout';

/** Without workers the thread is handed back after so many milliseconds of building; a step more can follow. */
const SLICE_MS = 6;

/** A build that somebody waits for. */
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

/** Builds what waits on the calling thread, in slices. */
export class BuildsHere {
  #building = false;

  /** Goes on until nothing waits; does nothing where it is at it. */
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
        // What settles the job otherwise, an abort say, ends its build.
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
    // Within the turn in which the last one was done: who asks next finds either this running or the way free.
    this.#building = false;
  }
}

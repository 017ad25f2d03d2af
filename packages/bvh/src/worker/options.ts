import type { BlasOptions } from '../blas';
import type { NodeWorkerLike, WebWorkerLike } from './connection';

/** Options for `BvhWorkers.create`. */
export interface BvhWorkersOptions {
  /** Number of workers, at least 1. Default: the machine's threads, at most 8. */
  readonly count?: number;
  /**
   * Makes a worker that runs `@glanz/bvh/worker`, where the default does not suit a bundler or a page's content
   * security policy, e.g. `() => new Worker(myUrl, { type: 'module' })`, or one of Node's `worker_threads`.
   */
  readonly createWorker?: () => WebWorkerLike | NodeWorkerLike;
  /**
   * Let each worker build small synthetic meshes for about a tenth of a second, two workers at a time, so that its
   * first real build runs optimised code. Builds requested meanwhile have priority. Default false.
   */
  readonly warmUp?: boolean;
  /**
   * Let two workers build one mesh of 200,000 triangles or more where no other build is queued and memory can be shared
   * (a page that is `crossOriginIsolated`, Node); elsewhere one builds it. The result is the same. Default: on machines
   * of four threads and more. With fewer, no core is idle: the page's own thread and the GPU's process have work too.
   */
  readonly together?: boolean;
}

/** Options for `BvhWorkers.buildBlas`, besides those of `buildBlas`. */
export interface WorkerBuildOptions extends BlasOptions {
  /** Cancels: the promise rejects at once with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
  /** Called with 0 when the build begins and 1 when it is done; in between only for builds on the calling thread. */
  readonly onProgress?: ((done: number) => void) | undefined;
  /**
   * Transfer the mesh's buffers instead of copying them: the caller's arrays are detached. For arrays that fill their
   * buffers; others are copied. Arrays over a SharedArrayBuffer are never copied. Default false.
   */
  readonly transfer?: boolean;
}

import type { BlasOptions } from '../blas';
import type { NodeWorkerLike, WebWorkerLike } from './line';

/** What `BvhWorkers.create` may be told. */
export interface BvhWorkersOptions {
  /** Workers, at least 1. Default: the machine's threads, at most 8. */
  readonly count?: number;
  /**
   * Makes a worker that runs `@glanz/bvh/worker`, where the package's own way does not fit a bundler or a page's
   * policy, e.g. `() => new Worker(myUrl, { type: 'module' })`, or one of Node's `worker_threads`.
   */
  readonly createWorker?: () => WebWorkerLike | NodeWorkerLike;
  /**
   * Let each worker build small made-up meshes for about a tenth of a second, two workers at a time, so that its first
   * real build runs optimised code. Builds that are asked for meanwhile come first. Default false.
   */
  readonly warmUp?: boolean;
  /**
   * Let two workers build one mesh of 200,000 triangles or more where nothing else waits and memory can be shared (a
   * page that is `crossOriginIsolated`, Node); elsewhere one builds it. The result is the same. Default: on machines of
   * four threads and more. With fewer there is no core to spare: the page's own thread and the GPU's process have work
   * too.
   */
  readonly together?: boolean;
}

/** What `BvhWorkers.buildBlas` may be told besides the options of `buildBlas`. */
export interface WorkerBuildOptions extends BlasOptions {
  /** Gives up: the promise rejects at once with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
  /** Told 0 when the build begins and 1 when it is done; in between only where builds run on the calling thread. */
  readonly onProgress?: ((done: number) => void) | undefined;
  /**
   * Hand the mesh's buffers over instead of copying them: the caller's arrays are empty from then on. For arrays that
   * fill their buffers; others are copied. Arrays over a SharedArrayBuffer are never copied. Default false.
   */
  readonly transfer?: boolean;
}

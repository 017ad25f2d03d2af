import { blasSteps, type Blas, type BlasOptions } from './blas';
import type { TriangleMesh } from './layout';

/** Options for {@link buildBlasAsync}, besides those of `buildBlas`. */
export interface AsyncBuildOptions extends BlasOptions {
  /** Cancels: the promise rejects with the signal's reason within a slice. */
  readonly signal?: AbortSignal | undefined;
  /** Called after each slice with the completed fraction, 0..1; the last is 1. */
  readonly onProgress?: ((done: number) => void) | undefined;
  /** Length of a slice, milliseconds; it may overrun by a few. Default 6. */
  readonly sliceMs?: number;
}

/** Lets other tasks of the event loop run. */
export function yieldToEventLoop(): Promise<void> {
  const { scheduler, setImmediate: soon = setTimeout } = globalThis as {
    scheduler?: { yield?: () => Promise<void> };
    setImmediate?: (task: () => void) => unknown;
  };
  return scheduler?.yield?.() ?? new Promise((resolve) => void soon(resolve));
}

/**
 * Builds the same hierarchy as `buildBlas`, on the calling thread in slices, so that a page stays responsive where
 * workers are unavailable. The mesh must not change until the promise settles.
 *
 * @throws {BvhError} as `buildBlas` does.
 * @throws the signal's reason when aborted, or what `onProgress` throws.
 * @example
 * const blas = await buildBlasAsync(mesh, { signal, onProgress: (done) => (bar.value = done) });
 */
export async function buildBlasAsync(mesh: TriangleMesh, options: AsyncBuildOptions = {}): Promise<Blas> {
  const { signal, onProgress, sliceMs = 6, ...own } = options;
  signal?.throwIfAborted();
  const steps = blasSteps(mesh, own);
  let until = performance.now() + sliceMs;
  for (;;) {
    const step = steps.next();
    if (step.done) {
      onProgress?.(1);
      return step.value;
    }
    if (performance.now() < until) continue;
    onProgress?.(Math.min(1, step.value));
    await yieldToEventLoop();
    signal?.throwIfAborted();
    until = performance.now() + sliceMs;
  }
}

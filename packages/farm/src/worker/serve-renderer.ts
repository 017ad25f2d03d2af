import type { FromRenderer, RenderedFiles, RendererFailure, ToRenderer } from './renderer-process';

/** What renders jobs in a renderer's process. */
export interface JobRenderer {
  /**
   * Renders one job into files.
   *
   * @param signal Aborts when the job is to be given back: keep the samples in `message.checkpoint` and return
   * `undefined`.
   * @throws what `failureOf` understands
   */
  render(
    message: Extract<ToRenderer, { readonly type: 'job' }>,
    signal: AbortSignal,
    onProgress: (samples: number, of: number) => void,
  ): Promise<RenderedFiles | undefined>;
  /** What an error means for the job. */
  failureOf(error: unknown): { readonly kind: RendererFailure; readonly code: string; readonly message: string };
}

/** Milliseconds between two messages while no sample is finished, as during compilation. */
const MESSAGE_MS = 5_000;

/**
 * Renders the jobs that the worker which started this process sends, and ends this process when the worker has ended. Progress is reported at
 * most ten times a second.
 */
export function serveRenderer(renderer: JobRenderer): Promise<never> {
  let stop = new AbortController();
  const send = (message: FromRenderer) => {
    if (process.connected) process.send?.(message);
  };
  const work = async (message: Extract<ToRenderer, { readonly type: 'job' }>) => {
    const { signal } = stop;
    let last: readonly [number, number] = [0, 0];
    let sentAt = 0;
    const report = () => {
      sentAt = Date.now();
      send({ type: 'progress', samples: last[0], of: last[1] });
    };
    const timer = setInterval(report, MESSAGE_MS);
    try {
      const done = await renderer.render(message, signal, (samples, of) => {
        last = [samples, of];
        if (Date.now() - sentAt >= 100) report();
      });
      send(done ? { type: 'done', ...done } : { type: 'stopped' });
    } catch (error) {
      if (signal.aborted && error === signal.reason) send({ type: 'stopped' });
      else send({ type: 'failed', ...renderer.failureOf(error) });
    } finally {
      clearInterval(timer);
    }
  };
  return new Promise<never>(() => {
    process.on('message', (message: ToRenderer) => {
      if (message.type === 'stop') return stop.abort();
      stop = new AbortController();
      void work(message);
    });
    // The worker was killed: nothing would read the files.
    process.once('disconnect', () => process.exit());
    // Signals from the terminal reach both; the worker decides.
    process.on('SIGINT', () => undefined);
    process.on('SIGTERM', () => undefined);
  });
}

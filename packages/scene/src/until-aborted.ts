/**
 * Waits for work that heeds no signal by itself, or heeds it late, such as the compilation of a shader.
 *
 * @param late Frees what the work gives after the signal has aborted.
 * @returns What the work gives.
 * @throws what the work throws, or the signal's reason as soon as it aborts. The work itself goes on.
 */
export function untilAborted<T>(
  work: Promise<T>,
  signal: AbortSignal | undefined,
  late?: (result: T) => void,
): Promise<T> {
  if (!signal) return work;
  return new Promise((resolve, reject) => {
    const abort = () => reject(signal.reason as Error);
    if (signal.aborted) abort();
    else signal.addEventListener('abort', abort, { once: true });
    work.then(
      (result) => {
        signal.removeEventListener('abort', abort);
        if (signal.aborted) late?.(result);
        else resolve(result);
      },
      (error: unknown) => {
        signal.removeEventListener('abort', abort);
        reject(error as Error);
      },
    );
  });
}

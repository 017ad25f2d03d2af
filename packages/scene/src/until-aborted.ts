/**
 * Waits for work that ignores abort signals, or reacts to them late, such as the compilation of a shader.
 *
 * @param late Receives a result that arrives after the abort, to free it.
 * @returns The result of the work.
 * @throws What the work throws, or the signal's reason as soon as it aborts. The work itself continues.
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

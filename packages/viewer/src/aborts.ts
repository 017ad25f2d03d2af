/** The reason for which an operation is aborted. */
export const abortError = (message = 'the viewer was destroyed'): DOMException =>
  new DOMException(message, 'AbortError');

/** Whether an operation was aborted. */
export const isAbort = (error: unknown): boolean => (error as { name?: unknown } | null)?.name === 'AbortError';

/** Whether an operation failed because the device was lost. */
export const isLoss = (error: unknown): boolean =>
  (error as { code?: unknown } | null)?.code === 'renderer/device-lost';

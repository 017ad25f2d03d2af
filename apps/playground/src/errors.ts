import { GlanzError } from '@glanz/scene';

/**
 * Thrown by the page itself, and in place of errors that happened in its worker. Codes: `playground/<what>`, or those
 * of the loader.
 */
export class PlaygroundError extends GlanzError {}

/** An error as one line, with its code where it has one. */
export function describeError(error: unknown): { readonly message: string; readonly code: string } {
  const { message, code } = (typeof error === 'object' && error !== null ? error : { message: String(error) }) as {
    message?: string;
    code?: unknown;
  };
  const line = (message ?? 'Something failed.').split('\n')[0] as string;
  return { message: line, code: typeof code === 'string' ? code : 'unexpected' };
}

/** Whether an operation was aborted. */
export const isAbort = (error: unknown): boolean => error instanceof DOMException && error.name === 'AbortError';

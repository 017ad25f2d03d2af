import { GlanzError } from '@glanz/scene';
import type { Fault, FaultPoint } from '@glanz/gpu/faults';

/** Whose calls fail. */
export type Subject = 'tracer' | 'viewer' | 'cli';

/**
 * How a fault ended. `image`: the right image, bit for bit. `error`: a typed error, and the call repeated without the
 * fault gave the right image. The others are failures; `crash`: the process died.
 */
export type Ending =
  | 'image'
  | 'error'
  | 'crash'
  | 'silent'
  | 'hang'
  | 'unhandled'
  | 'untyped'
  | 'unusable'
  | 'not-rolled-back'
  | 'leak';

/** One injected fault and how it ended. */
export interface Outcome {
  readonly subject: Subject;
  /** See {@link FaultPoint.name}. */
  readonly point: string;
  /** `tab-hidden` is the viewer's alone. */
  readonly fault: Fault | 'tab-hidden';
  readonly ending: Ending;
  /** The code of the error, or what was wrong. */
  readonly detail?: string;
}

/** Whether a fault was survived. */
export const survived = ({ ending }: Outcome): boolean => ending === 'image' || ending === 'error';

/** A point and what it shall meet. */
export interface Trial {
  readonly point: FaultPoint;
  readonly fault: Fault;
}

/** What a call led to within its time. */
export type Attempt<T> =
  | { readonly kind: 'value'; readonly value: T }
  | { readonly kind: 'error'; readonly error: unknown }
  | { readonly kind: 'hang' };

/** Waits for a call, but not for ever. */
export async function attempt<T>(call: () => T | Promise<T>, milliseconds: number): Promise<Attempt<T>> {
  let timer: NodeJS.Timeout | undefined;
  const bound = new Promise<Attempt<T>>(
    (resolve) => (timer = setTimeout(() => resolve({ kind: 'hang' }), milliseconds)),
  );
  try {
    const work = (async (): Promise<Attempt<T>> => ({ kind: 'value', value: await call() }))().catch(
      (error: unknown): Attempt<T> => ({ kind: 'error', error }),
    );
    return await Promise.race([work, bound]);
  } finally {
    clearTimeout(timer);
  }
}

/** The code of a typed error, or `undefined`. */
export const codeOf = (error: unknown): string | undefined => (error instanceof GlanzError ? error.code : undefined);

/** An error for a report: one line, its type in front. */
export const describe = (error: unknown): string =>
  `${codeOf(error) ?? (error as Error)?.name ?? typeof error}: ${String((error as Error)?.message ?? error)
    .split('\n', 1)[0]
    ?.slice(0, 160)}`;

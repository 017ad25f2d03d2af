/** Items that one step looks at: a millisecond or two. */
export const STEP = 1 << 14;

/**
 * Parts of a build: generators that do a few milliseconds of work at a time and yield the share of the part that is
 * done.
 */
export type Steps<T> = Generator<number, T>;

/** Runs a part as the share `from` to `to` of a whole. */
export function* part<T>(steps: Steps<T>, from: number, to: number): Steps<T> {
  let step = steps.next();
  for (; !step.done; step = steps.next()) yield from + (to - from) * step.value;
  return step.value;
}

/** Does some work, told from where to where, for all of `count`. */
export function* each(count: number, step: number, work: (from: number, to: number) => void): Steps<void> {
  for (let from = 0; from < count; from += step) {
    work(from, Math.min(count, from + step));
    yield from / count;
  }
}

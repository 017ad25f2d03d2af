/** Items that one step visits: a millisecond or two. */
export const STEP = 1 << 14;

/**
 * Parts of a build: generators that do a few milliseconds of work at a time and yield the completed fraction of the
 * part.
 */
export type Steps<T> = Generator<number, T>;

/** Runs a part whose progress counts as `from` to `to` of the whole. */
export function* part<T>(steps: Steps<T>, from: number, to: number): Steps<T> {
  let step = steps.next();
  for (; !step.done; step = steps.next()) yield from + (to - from) * step.value;
  return step.value;
}

/** Calls `work` with successive ranges that cover `count`. */
export function* each(count: number, step: number, work: (from: number, to: number) => void): Steps<void> {
  for (let from = 0; from < count; from += step) {
    work(from, Math.min(count, from + step));
    yield from / count;
  }
}

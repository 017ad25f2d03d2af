/** An error after some time. */
export interface Point {
  readonly milliseconds: number;
  readonly error: number;
}

/**
 * When an error falls to a limit and stays there, interpolated between measurements on logarithmic scales.
 *
 * @param points In order of time.
 * @returns Milliseconds; that of the first point where it is low enough already, undefined if it never is.
 */
export function crossing(points: readonly Point[], limit: number): number | undefined {
  const last = points.findLastIndex(({ error }) => error > limit);
  const [before, after] = [points[last], points[last + 1]];
  if (!after) return undefined;
  if (!before) return after.milliseconds;
  const share = Math.log(before.error / limit) / Math.log(before.error / after.error);
  return before.milliseconds * (after.milliseconds / before.milliseconds) ** share;
}

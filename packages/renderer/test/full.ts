/** Cases that one fault would make fail together: the first of them, with `npm test -- --full` all. */
export const casesOf = <T>(...cases: readonly [T, ...(readonly T[])]): readonly T[] =>
  process.env['GLANZ_FULL'] === undefined ? cases.slice(0, 1) : cases;

/** A number of samples, with `npm test -- --full` a multiple of it. */
export const samplesOf = (samples: number, factor: number): number =>
  process.env['GLANZ_FULL'] === undefined ? samples : factor * samples;

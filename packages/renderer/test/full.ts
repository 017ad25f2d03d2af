/** A number of samples, with `npm test -- --full` a multiple of it. */
export const samplesOf = (samples: number, factor: number): number =>
  process.env['GLANZ_FULL'] === undefined ? samples : factor * samples;

/**
 * Whether a point of a grid is tested: with GLANZ_FULL all of them, else one in `every` along each axis, so that each
 * value of each parameter is there, and each pair of values of a grid with three axes of that length.
 */
export const inSample = (every: number, ...place: readonly number[]): boolean =>
  process.env['GLANZ_FULL'] !== undefined || place.reduce((a, b) => a + b) % every === 0;

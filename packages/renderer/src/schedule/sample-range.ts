/** Samples that are added up before they join the film's total. */
export const FILM_CHUNK = 16;

/** The first samples of a film that are the end of a chunk: 0 if the film begins where a chunk does. */
export const headSamples = (first: number): number => (FILM_CHUNK - (first % FILM_CHUNK)) % FILM_CHUNK;

/** Number of the first sample after {@link headSamples}. */
export const headEnd = (first: number): number => first + headSamples(first);

/** Ranges of sample numbers, each from the first to the one after the last, in ascending order. */
export type SampleRanges = readonly (readonly [first: number, end: number])[];

/** How many samples of a chunk are in the ranges. */
export const samplesInChunk = (ranges: SampleRanges, chunk: number): number =>
  ranges.reduce(
    (sum, [first, end]) =>
      sum + Math.max(0, Math.min(end, (chunk + 1) * FILM_CHUNK) - Math.max(first, chunk * FILM_CHUNK)),
    0,
  );

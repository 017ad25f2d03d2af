import type { FilmState } from './film-state';

/** Numbers of floats of a film's sums. */
export const sumLengths = ({
  width,
  height,
  lightPasses,
}: Pick<FilmState, 'width' | 'height' | 'lightPasses'>): Record<keyof FilmState['sums'], number> => {
  const pixel = 4 * width * height;
  return { film_block: lightPasses * pixel, film_total: lightPasses * pixel, film_moment: pixel, beauty: pixel };
};

/** The numbers of a film's samples, for people: `0–49, 100–149`. */
export const rangesText = ({ ranges }: Pick<FilmState, 'ranges'>): string =>
  ranges.map(([first, end]) => `${first}–${end - 1}`).join(', ');

/**
 * Why a film cannot be resumed in a tracer; `undefined`: it can. Imports nothing, so that it is a chunk by itself.
 *
 * @param film Of the tracer.
 * @param tiles Tiles of the tracer's film.
 * @param chunks Chunks that must be among the film's parts.
 */
export function filmStateFault(
  state: FilmState,
  film: Pick<FilmState, 'width' | 'height' | 'lightPasses' | 'fingerprint'>,
  tiles: number,
  chunks: readonly number[],
): string | undefined {
  if (state.width !== film.width || state.height !== film.height)
    return `it has ${state.width} × ${state.height} pixels, and this film has ${film.width} × ${film.height}`;
  if (state.lightPasses !== film.lightPasses)
    return `it has ${state.lightPasses} light passes, not ${film.lightPasses}`;
  if (state.fingerprint !== film.fingerprint) return 'it is of another scene, camera, or other options';
  if (state.ranges.length !== 1)
    return `some of its samples are missing (it has ${rangesText(state)}); merge it with the films that have them`;
  const { counts, tiles: under, pixel } = state.sampling;
  const lengths = sumLengths(film);
  const fits =
    counts.length === tiles && (under?.every((tile) => tile < tiles) ?? true) && pixel < film.width * film.height;
  const wholeParts =
    String(state.parts.map(({ chunk }) => chunk)) === String(chunks) &&
    state.parts.every(({ sums }) => sums.length === lengths.film_total);
  const sound = Object.entries(lengths).every(
    ([name, length]) => state.sums[name as keyof typeof lengths].length === length,
  );
  return fits && wholeParts && sound ? undefined : 'its parts do not fit together';
}

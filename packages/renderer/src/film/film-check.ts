import { RenderError } from '../errors';
import { FILM_CHUNK, headEnd, headSamples } from '../schedule/sample-range';
import { FILM_SUMS, rangesText, sumLengths, type FilmState } from './film-state';

/**
 * Checks that a film can go on in a tracer with this film.
 * @param tiles Tiles of the tracer's film.
 * @throws {RenderError} `renderer/film-state`
 */
export function checkFilmState(
  state: FilmState,
  film: Pick<FilmState, 'width' | 'height' | 'planes' | 'fingerprint'>,
  tiles: number,
): void {
  const refuse = (why: string) =>
    new RenderError('renderer/film-state', `The saved film cannot be resumed here: ${why}.`);
  if (state.width !== film.width || state.height !== film.height)
    throw refuse(`it has ${state.width} × ${state.height} pixels, and this film has ${film.width} × ${film.height}`);
  if (state.planes !== film.planes)
    throw refuse(`it keeps ${state.planes} light sums apart, and this film ${film.planes}`);
  if (state.fingerprint !== film.fingerprint) throw refuse('it is of another scene, camera, or other options');
  if (state.ranges.length !== 1)
    throw refuse(
      `of its samples some are missing (it has ${rangesText(state)}); merge it with the films that have the others`,
    );
  const [first] = state.ranges[0] as readonly [number, number];
  const heads =
    headSamples(first) > 0 && state.sampling.sample >= headEnd(first) ? [Math.floor(first / FILM_CHUNK)] : [];
  const { counts, tiles: under, pixel } = state.sampling;
  const lengths = sumLengths(film);
  const fits =
    counts.length === tiles && (under?.every((tile) => tile < tiles) ?? true) && pixel < film.width * film.height;
  const wholeParts =
    String(state.parts.map(({ chunk }) => chunk)) === String(heads) &&
    state.parts.every(({ sums }) => sums.length === lengths[1]);
  if (!fits || !wholeParts || FILM_SUMS.some((name, i) => state.sums[name].length !== lengths[i]))
    throw refuse('its parts do not fit together');
}

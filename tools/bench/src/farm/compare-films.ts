import { readFileSync } from 'node:fs';
import { decodeFilmState, type FilmState } from '@glanz/renderer/film';
import { BenchError } from '../error';

/** Reads the film of a `.film` file, which stands behind two lines. */
export function readFilm(file: string): FilmState {
  const bytes = readFileSync(file);
  const end = bytes.indexOf(10, bytes.indexOf(10) + 1) + 1;
  return decodeFilmState(new Uint8Array(bytes.buffer, bytes.byteOffset + end, bytes.length - end));
}

/** How the sums of two films of one image differ. */
export interface FilmDifference {
  /** Of the sums that are not 0, those with the same bits. */
  readonly equal: number;
  /** Maximum difference relative to the value. */
  readonly max: number;
  /** What `mergeFilmStates` promises. */
  readonly bound: number;
}

/**
 * Compares a film that was put together with that of one run.
 *
 * @throws {BenchError} `bench/farm` for films of different images or samples
 */
export function compareFilms(merged: FilmState, whole: FilmState): FilmDifference {
  const kind = ({ width, height, samples, fingerprint }: FilmState) =>
    JSON.stringify([width, height, samples, fingerprint]);
  if (kind(merged) !== kind(whole))
    throw new BenchError('bench/farm', `The films are of different images: ${kind(merged)} and ${kind(whole)}.`);
  const [a, b] = [merged.sums.film_total, whole.sums.film_total];
  let [values, equal, max] = [0, 0, 0];
  for (let i = 0; i < b.length; i++) {
    const value = b[i] as number;
    const difference = Math.abs((a[i] as number) - value);
    if (value === 0 && difference === 0) continue;
    values++;
    if (difference === 0) equal++;
    else max = Math.max(max, difference / Math.abs(value));
  }
  return { equal: equal / Math.max(1, values), max, bound: (whole.samples / 16 + 16) * 2 ** -23 };
}

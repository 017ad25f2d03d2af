import { RenderError } from '../errors';
import { FILM_CHUNK, samplesInChunk, type SampleRanges } from '../schedule/sample-range';
import { readFilmState } from './compose';
import { rangesText, sumLengths } from './film-check';
import { FILM_SUMS, type FilmPart, type FilmState } from './film-state';
import type { GroupWeights } from './layers';

/** @param why Films cannot be merged. */
export const refuse = (why: string) => new RenderError('renderer/film-state', `These films cannot be merged: ${why}.`);

/**
 * Adds up films of the same image with different samples, such as 0–49 and 50–99, which several processes, machines or
 * GPUs have rendered. The order of the films does not matter, and they may have gaps between their samples; without
 * gaps the result can be resumed by `PathTracer.restoreFilm`.
 *
 * The sums are added in double precision and rounded once to single precision, chunks of 16 samples that were split
 * between films are put together, and the variance follows. One run over all samples rounds after each chunk instead, so
 * its values differ by at most `(n / 16 + 16) · 2⁻²³` of the value for n samples; where a film is appended that has one
 * whole chunk, `film_total` is the same bit for bit.
 *
 * @param films At least one; they are not changed. Light groups must be set alike.
 * @throws {RenderError} `renderer/film-state` for films of different sizes, scenes, cameras, options or light groups,
 * films that have samples in common, and films whose pixels have different numbers of samples (saved in the middle of a
 * sample, or rendered to a noise target).
 */
export function mergeFilmStates(films: readonly FilmState[]): FilmState {
  if (films.length === 0) throw refuse('there is none');
  const sorted = films
    .filter((film) => checked(film).samples > 0)
    .sort((a, b) => (a.ranges[0]?.[0] as number) - (b.ranges[0]?.[0] as number));
  const [model = films[0] as FilmState] = sorted;
  for (const film of films) checkSame(film, model);
  if (sorted.length < 2) return model;
  const ranges = union(sorted);
  const end = (ranges.at(-1) as readonly [number, number])[1];
  const total = added(sorted.map(({ sums }) => sums.film_total));
  const moment = added(sorted.map(({ sums }) => sums.film_moment));
  let block: Float64Array | undefined;
  const parts: FilmPart[] = [];
  for (const [chunk, { inTotal, inBlocks }] of [...partsOf(sorted)].sort(([a], [b]) => a - b)) {
    const sums = added([...inTotal, ...inBlocks]);
    const samples = samplesInChunk(ranges, chunk);
    if (samples < FILM_CHUNK && chunk === Math.floor(end / FILM_CHUNK)) {
      block = sums;
      continue;
    }
    for (const part of inBlocks) addTo(total, part);
    if (samples < FILM_CHUNK) parts.push({ chunk, sums: new Float32Array(sums) });
    else addMoment(moment, sums, model);
  }
  const samples = ranges.reduce((sum, [first, last]) => sum + last - first, 0);
  const merged: FilmState = {
    ...model,
    samples,
    ranges,
    badSamples: sorted.reduce((sum, { badSamples }) => sum + badSamples, 0),
    parts,
    sampling: samplingTo(end, model.sampling.counts.length),
    sums: {
      // Not `Float32Array.from`, which takes fifty times as long for large films.
      film_block: block ? new Float32Array(block) : new Float32Array(total.length),
      film_total: new Float32Array(total),
      film_moment: new Float32Array(moment),
      beauty: model.sums.beauty,
    },
  };
  return { ...merged, sums: { ...merged.sums, beauty: readFilmState(merged, 'beauty') } };
}

/** The sampling of a film with all samples to an end. @param tiles Numbers of its sampling's counts. */
export const samplingTo = (end: number, tiles: number): FilmState['sampling'] => ({
  counts: new Uint32Array(tiles).fill(end),
  tiles: undefined,
  sample: end,
  pixel: 0,
  until: 0,
});

type Sampling = Pick<FilmState['sampling'], 'pixel' | 'sample'> & { readonly tiles: unknown };

/** That all pixels of a film have the same samples. @throws {RenderError} `renderer/film-state` */
export function checkSampling(sampling: Sampling): void {
  if (sampling.pixel > 0)
    throw refuse(
      `one was saved in the middle of sample ${sampling.sample}; save it when render() has ended, or resume it first`,
    );
  if (sampling.tiles)
    throw refuse('one was rendered to a noise target, so its pixels have different numbers of samples');
}

function checked(film: FilmState): FilmState {
  checkSampling(film.sampling);
  const lengths = sumLengths(film);
  if (FILM_SUMS.some((name) => film.sums[name].length !== lengths[name]))
    throw refuse('the sums of one do not have its size');
  return film;
}

type Settings = Pick<FilmState, 'width' | 'height' | 'fingerprint' | 'lightPasses' | 'weights'>;

/** That a film is of the same image as another. @throws {RenderError} `renderer/film-state` */
export function checkSame(film: Settings, model: Settings): void {
  if (film.width !== model.width || film.height !== model.height)
    throw refuse(`one has ${model.width} × ${model.height} pixels, another ${film.width} × ${film.height}`);
  if (film.fingerprint !== model.fingerprint || film.lightPasses !== model.lightPasses)
    throw refuse('they are of different scenes, cameras, or options');
  if (JSON.stringify(film.weights) !== JSON.stringify(model.weights))
    throw refuse('their light groups are not set alike; set them alike before saveFilm(), or after merging');
}

/** All samples of the films. @throws {RenderError} `renderer/film-state` if two have the same */
export function union(films: readonly Pick<FilmState, 'ranges'>[]): SampleRanges {
  const all = films.flatMap(({ ranges }) => ranges).sort((a, b) => a[0] - b[0]);
  const out: [number, number][] = [];
  for (const [first, end] of all) {
    const last = out.at(-1);
    if (last && first < last[1])
      throw refuse(`two have sample ${first} (${films.map(rangesText).join('; ')}): render each range of samples once`);
    if (last && first === last[1]) last[1] = end;
    else out.push([first, end]);
  }
  return out;
}

/** The sums of chunks that are not whole in a film: those that its total contains, and those that it does not. */
function partsOf(films: readonly FilmState[]): Map<number, { inTotal: Float32Array[]; inBlocks: Float32Array[] }> {
  const out = new Map<number, { inTotal: Float32Array[]; inBlocks: Float32Array[] }>();
  const at = (chunk: number) => {
    const entry = out.get(chunk) ?? { inTotal: [], inBlocks: [] };
    out.set(chunk, entry);
    return entry;
  };
  for (const { parts, ranges, sums } of films) {
    for (const part of parts) at(part.chunk).inTotal.push(part.sums);
    const end = (ranges.at(-1) as readonly [number, number])[1];
    if (end % FILM_CHUNK > 0) at(Math.floor(end / FILM_CHUNK)).inBlocks.push(sums.film_block);
  }
  return out;
}

function added(arrays: readonly Float32Array[]): Float64Array {
  const [first, ...others] = arrays;
  const out = new Float64Array(first as Float32Array);
  for (const array of others) addTo(out, array);
  return out;
}

function addTo(sum: Float64Array, array: Float32Array): void {
  for (let i = 0; i < sum.length; i++) sum[i] = (sum[i] as number) + (array[i] as number);
}

/** Adds the square of a whole chunk's mean, as `resolve.wesl` does. */
function addMoment(moment: Float64Array, sums: Float64Array, { lightPasses, weights: { first } }: FilmState): void {
  const groups = first.length;
  // With catchers, the light passes of the image without the objects do not count.
  const counted = Math.min(lightPasses, 2 * groups);
  for (let at = 0; at < moment.length; at += 4) {
    for (let c = 0; c < 3; c++) {
      let mean = 0;
      for (let pass = 0; pass < counted; pass++)
        mean += (first as GroupWeights)[pass % groups]![c]! * (sums[pass * moment.length + at + c] as number);
      mean /= FILM_CHUNK;
      moment[at + c] = (moment[at + c] as number) + mean * mean;
    }
  }
}

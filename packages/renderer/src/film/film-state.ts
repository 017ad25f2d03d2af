import { RenderError } from '../errors';
import type { SamplingState } from '../schedule/sampling';
import type { GroupWeights } from './layers';

/** The film's buffers that a {@link FilmState} holds, with vec4f per pixel: `planes` of them, or one. */
export const FILM_SUMS = ['film_block', 'film_total', 'film_moment', 'beauty'] as const;

/**
 * Everything that a film has accumulated, and where its sampling stands: what `PathTracer.saveFilm()` gives and
 * `PathTracer.restoreFilm()` takes. Plain data: it can be posted to a worker, kept while a device is replaced, or
 * written to a file with {@link encodeFilmState}.
 */
export interface FilmState {
  /** Pixels. */
  readonly width: number;
  readonly height: number;
  /** Completed samples per pixel; after sampling to a noise target, those of the pixels that have most. */
  readonly samples: number;
  /** Samples that were dropped because they were NaN, infinite or negative. */
  readonly badSamples: number;
  /** Sums that the film keeps apart: one for each light group, four for each with catchers. */
  readonly planes: number;
  /** Hash of the options, the camera and the scene that the samples are of. */
  readonly fingerprint: string;
  /** Where sampling goes on. */
  readonly sampling: SamplingState;
  /** Weights of the light groups when the film was begun, which its variance is of, and when it was saved. */
  readonly weights: { readonly first: GroupWeights; readonly last: GroupWeights };
  /** The film's buffers, RGBA, stride 4, row-major, top row first; `film_block` and `film_total` plane by plane. */
  readonly sums: Readonly<Record<(typeof FILM_SUMS)[number], Float32Array<ArrayBuffer>>>;
}

/** "GLZF", little-endian. */
const MAGIC = 0x465a4c47;
const VERSION = 1;
/** Magic, version, length of the JSON. */
const HEADER_BYTES = 12;

const broken = (what: string) =>
  new RenderError(
    'renderer/film-state',
    `These bytes are no film that can be resumed: ${what}. Render the film again from the start.`,
  );

type Head = Omit<FilmState, 'sampling' | 'sums'> & {
  readonly sample: number;
  readonly pixel: number;
  readonly until: number;
  readonly counts: number;
  readonly tiles: number;
};

/** Numbers of floats of the sums, in the order of {@link FILM_SUMS}. */
const sumLengths = ({ width, height, planes }: Pick<FilmState, 'width' | 'height' | 'planes'>): number[] => {
  const pixel = 4 * width * height;
  return [planes * pixel, planes * pixel, pixel, pixel];
};

/**
 * A film as bytes, for a file: a header, a line of JSON and the sums as they are (about `32 × planes + 32` bytes a
 * pixel). Little-endian; of this version of Glanz.
 */
export function encodeFilmState(state: FilmState): Uint8Array<ArrayBuffer> {
  const { sampling, sums, ...rest } = state;
  const { counts, tiles, sample, pixel, until } = sampling;
  const head: Head = { ...rest, sample, pixel, until, counts: counts.length, tiles: tiles?.length ?? -1 };
  const text = new TextEncoder().encode(JSON.stringify(head));
  // What follows begins at a multiple of four bytes.
  const textBytes = 4 * Math.ceil(text.length / 4);
  const parts = [counts, ...(tiles ? [tiles] : []), ...FILM_SUMS.map((name) => sums[name])];
  const bytes = new Uint8Array(parts.reduce((sum, part) => sum + part.byteLength, HEADER_BYTES + textBytes));
  const view = new DataView(bytes.buffer);
  [MAGIC, VERSION, textBytes].forEach((word, i) => view.setUint32(4 * i, word, true));
  bytes.fill(0x20, HEADER_BYTES, HEADER_BYTES + textBytes);
  bytes.set(text, HEADER_BYTES);
  let at = HEADER_BYTES + textBytes;
  for (const part of parts) {
    bytes.set(new Uint8Array(part.buffer, part.byteOffset, part.byteLength), at);
    at += part.byteLength;
  }
  return bytes;
}

/**
 * The film that {@link encodeFilmState} has written.
 * @throws {RenderError} `renderer/film-state` for bytes that are cut off, damaged, or of another version.
 */
export function decodeFilmState(bytes: Uint8Array): FilmState {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < HEADER_BYTES || view.getUint32(0, true) !== MAGIC) throw broken('they do not begin as one');
  if (view.getUint32(4, true) !== VERSION)
    throw broken(`they are of version ${view.getUint32(4, true)}, and this is version ${VERSION}`);
  const textBytes = view.getUint32(8, true);
  const head = readHead(bytes.subarray(HEADER_BYTES, HEADER_BYTES + textBytes));
  const lengths = sumLengths(head);
  const words = head.counts + Math.max(0, head.tiles) + lengths.reduce((a, b) => a + b, 0);
  let at = HEADER_BYTES + textBytes;
  if (bytes.length !== at + 4 * words)
    throw broken(`they are ${bytes.length} bytes, and such a film takes ${at + 4 * words}`);
  const next = (length: number) => {
    const part = bytes.slice(at, at + 4 * length).buffer as ArrayBuffer;
    at += 4 * length;
    return part;
  };
  const counts = new Uint32Array(next(head.counts));
  const tiles = head.tiles < 0 ? undefined : new Uint32Array(next(head.tiles));
  const sums = Object.fromEntries(
    FILM_SUMS.map((name, i) => [name, new Float32Array(next(lengths[i] as number))]),
  ) as unknown as FilmState['sums'];
  const { width, height, samples, badSamples, planes, fingerprint, weights, sample, pixel, until } = head;
  return {
    width,
    height,
    samples,
    badSamples,
    planes,
    fingerprint,
    weights,
    sampling: { counts, tiles, sample, pixel, until },
    sums,
  };
}

const isWhole = (value: unknown, least: number) => Number.isSafeInteger(value) && (value as number) >= least;
const isWeights = (value: unknown) =>
  Array.isArray(value) &&
  value.every((weight) => Array.isArray(weight) && weight.length === 3 && weight.every(Number.isFinite));

function readHead(text: Uint8Array): Head {
  let head: Head;
  try {
    head = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(text)) as Head;
  } catch (cause) {
    throw new RenderError(
      'renderer/film-state',
      'The header of this film cannot be read. Render the film again from the start.',
      { cause },
    );
  }
  const { width, height, planes, samples, badSamples, sample, pixel, until, counts, tiles, fingerprint, weights } =
    head ?? {};
  const whole =
    [width, height, planes].every((value) => isWhole(value, 1)) &&
    [samples, badSamples, sample, pixel, until, counts].every((value) => isWhole(value, 0)) &&
    isWhole(tiles, -1);
  if (!whole || typeof fingerprint !== 'string' || !isWeights(weights?.first) || !isWeights(weights?.last))
    throw broken('their header lacks something');
  return head;
}

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
  const { counts, tiles: under, pixel } = state.sampling;
  const lengths = sumLengths(film);
  const fits =
    counts.length === tiles && (under?.every((tile) => tile < tiles) ?? true) && pixel < film.width * film.height;
  if (!fits || FILM_SUMS.some((name, i) => state.sums[name].length !== lengths[i]))
    throw refuse('its parts do not fit together');
}

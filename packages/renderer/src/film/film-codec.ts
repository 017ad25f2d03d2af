import { RenderError } from '../errors';
import { sumLengths } from './film-check';
import { FILM_SUMS, type FilmPart, type FilmState } from './film-state';

/** "GLZF", little-endian. */
const MAGIC = 0x465a4c47;
const VERSION = 4;
/** Magic, version, length of the JSON, checksum of all that follows. */
const HEADER_BYTES = 16;

const broken = (what: string) =>
  new RenderError('renderer/film-state', `These bytes are no film that can be resumed: ${what}. Render it again.`);

type Head = Omit<FilmState, 'sampling' | 'sums' | 'parts'> & {
  readonly parts: readonly number[];
  /** Sums that are 0 everywhere, which are left out: `film_block` after whole chunks, for one. */
  readonly zero: readonly (typeof FILM_SUMS)[number][];
  readonly sample: number;
  readonly pixel: number;
  readonly until: number;
  readonly counts: number;
  readonly tiles: number;
};

/** FNV-1a over 32-bit words: each step is a bijection, so no change of a single word goes unnoticed. */
function checksum(bytes: Uint8Array<ArrayBuffer>): number {
  const words = new Uint32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength >>> 2);
  let hash = 0x811c9dc5;
  for (let i = 0; i < words.length; i++) hash = Math.imul(hash ^ (words[i] as number), 0x01000193);
  return hash >>> 0;
}

/** Whether all words are 0; -0 is something else. */
function isZero({ buffer, byteOffset, length }: Float32Array<ArrayBuffer>): boolean {
  const words = new Uint32Array(buffer, byteOffset, length);
  for (let i = 0; i < length; i++) if (words[i] !== 0) return false;
  return true;
}

/**
 * A film as bytes, for a file: a header with a checksum, a line of JSON and the sums as they are (at most about
 * `32 × lightPasses + 32` bytes a pixel; sums that are 0 everywhere take none). Little-endian; for this version of Glanz.
 */
export function encodeFilmState(state: FilmState): Uint8Array<ArrayBuffer> {
  const { sampling, sums, parts: partial, ...rest } = state;
  const { counts, tiles, sample, pixel, until } = sampling;
  const zero = FILM_SUMS.filter((name) => isZero(sums[name]));
  const head: Head = {
    ...rest,
    parts: partial.map(({ chunk }) => chunk),
    zero,
    sample,
    pixel,
    until,
    counts: counts.length,
    tiles: tiles?.length ?? -1,
  };
  const text = new TextEncoder().encode(JSON.stringify(head));
  // What follows begins at a multiple of four bytes.
  const textBytes = 4 * Math.ceil(text.length / 4);
  const parts = [
    counts,
    ...(tiles ? [tiles] : []),
    ...FILM_SUMS.filter((name) => !zero.includes(name)).map((name) => sums[name]),
    ...partial.map((part) => part.sums),
  ];
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
  view.setUint32(12, checksum(bytes.subarray(HEADER_BYTES)), true);
  return bytes;
}

/**
 * The film that {@link encodeFilmState} has written.
 * @throws {RenderError} `renderer/film-state` for bytes that are no film, cut off, damaged, or of another version.
 */
export function decodeFilmState(bytes: Uint8Array): FilmState {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < HEADER_BYTES || view.getUint32(0, true) !== MAGIC) throw broken('they do not begin as one');
  if (view.getUint32(4, true) !== VERSION)
    throw broken(`they are of version ${view.getUint32(4, true)}, and this is version ${VERSION}`);
  // A copy if the words are not aligned in the caller's buffer.
  const body = (bytes.byteOffset % 4 === 0 ? bytes : bytes.slice()).subarray(HEADER_BYTES) as Uint8Array<ArrayBuffer>;
  if (bytes.length % 4 !== 0 || checksum(body) !== view.getUint32(12, true))
    throw broken('they are damaged or cut off: their checksum is another one');
  const textBytes = view.getUint32(8, true);
  const head = readHead(bytes.subarray(HEADER_BYTES, HEADER_BYTES + textBytes));
  const lengths = sumLengths(head);
  const words =
    head.counts +
    Math.max(0, head.tiles) +
    FILM_SUMS.reduce((sum, name) => sum + (head.zero.includes(name) ? 0 : lengths[name]), 0) +
    head.parts.length * lengths.film_total;
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
    FILM_SUMS.map((name) => [
      name,
      head.zero.includes(name) ? new Float32Array(lengths[name]) : new Float32Array(next(lengths[name])),
    ]),
  ) as unknown as FilmState['sums'];
  const parts = head.parts.map((chunk): FilmPart => ({ chunk, sums: new Float32Array(next(lengths.film_total)) }));
  const { width, height, samples, ranges, badSamples, lightPasses, fingerprint, weights, sample, pixel, until } = head;
  return {
    width,
    height,
    samples,
    ranges,
    badSamples,
    lightPasses,
    fingerprint,
    weights,
    parts,
    sampling: { counts, tiles, sample, pixel, until },
    sums,
  };
}

const isWhole = (value: unknown, min: number) => Number.isSafeInteger(value) && (value as number) >= min;
const isWeights = (value: unknown) =>
  Array.isArray(value) &&
  value.every((weight) => Array.isArray(weight) && weight.length === 3 && weight.every(Number.isFinite));

const isRanges = (value: unknown) =>
  Array.isArray(value) &&
  value.length > 0 &&
  value.every(
    (range: unknown, i) =>
      Array.isArray(range) &&
      range.length === 2 &&
      isWhole(range[0], i === 0 ? 0 : (value as number[][])[i - 1]![1]! + 1) &&
      isWhole(range[1], (range[0] as number) + (i === 0 ? 0 : 1)),
  );

function readHead(text: Uint8Array): Head {
  let head: Head;
  try {
    head = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(text)) as Head;
  } catch (cause) {
    throw new RenderError('renderer/film-state', 'The header of this film cannot be read. Render it again.', { cause });
  }
  const { width, height, lightPasses, samples, ranges, badSamples, sample, pixel, until, counts, tiles } = head ?? {};
  const { fingerprint, weights, parts, zero } = head ?? {};
  const whole =
    [width, height, lightPasses].every((value) => isWhole(value, 1)) &&
    [samples, badSamples, sample, pixel, until, counts].every((value) => isWhole(value, 0)) &&
    isWhole(tiles, -1);
  const lists =
    isRanges(ranges) && Array.isArray(zero) && Array.isArray(parts) && parts.every((chunk) => isWhole(chunk, 0));
  if (!whole || !lists || typeof fingerprint !== 'string' || !isWeights(weights?.first) || !isWeights(weights?.last))
    throw broken('their header lacks something');
  return head;
}

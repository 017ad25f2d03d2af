import { RenderError } from '../errors';
import { sumLengths } from './film-check';
import { FILM_SUMS, type FilmPart, type FilmState } from './film-state';

/** "GLZF", little-endian. */
const MAGIC = 0x465a4c47;
const VERSION = 5;
/** Words of a {@link Checksum}. */
const LANES = 4;
/** Magic, version, length of the JSON, checksum of all that follows. */
export const HEADER_BYTES = 12 + 4 * LANES;

/** @param what Why bytes are not a film. */
export const broken = (what: string) =>
  new RenderError('renderer/film-state', `These bytes are not a film that can be resumed: ${what}. Render it again.`);

/** What the line of JSON in an encoded film says. */
export type FilmHead = Omit<FilmState, 'sampling' | 'sums' | 'parts'> & {
  readonly parts: readonly number[];
  /** Sums that are 0 everywhere, which are left out: `film_block` after whole chunks, for one. */
  readonly zero: readonly (typeof FILM_SUMS)[number][];
  readonly sample: number;
  readonly pixel: number;
  readonly until: number;
  readonly counts: number;
  readonly tiles: number;
};

/**
 * FNV-1a over 32-bit words, in four lanes: word i counts in lane i mod 4. Each step is a bijection, so no change of a
 * single word goes unnoticed; lanes do not wait for one another, which one chain of multiplications would.
 */
export class Checksum {
  readonly #lanes = new Uint32Array(LANES).fill(0x811c9dc5);
  /** Words so far. */
  #at = 0;

  /** Counts the next bytes: whole words. */
  add({ buffer, byteOffset, byteLength }: ArrayBufferView<ArrayBuffer>): this {
    const words = new Uint32Array(buffer, byteOffset, byteLength >>> 2);
    let i = 0;
    for (; i < words.length && this.#at % LANES > 0; i++) this.#one(words[i] as number);
    let [a, b, c, d] = this.#lanes as unknown as [number, number, number, number];
    const whole = words.length - ((words.length - i) % LANES);
    this.#at += whole - i;
    for (; i < whole; i += LANES) {
      a = Math.imul(a ^ (words[i] as number), 0x01000193);
      b = Math.imul(b ^ (words[i + 1] as number), 0x01000193);
      c = Math.imul(c ^ (words[i + 2] as number), 0x01000193);
      d = Math.imul(d ^ (words[i + 3] as number), 0x01000193);
    }
    this.#lanes.set([a, b, c, d]);
    for (; i < words.length; i++) this.#one(words[i] as number);
    return this;
  }

  #one(word: number): void {
    const lane = this.#at++ % LANES;
    this.#lanes[lane] = Math.imul((this.#lanes[lane] as number) ^ word, 0x01000193);
  }

  /** The sums, as a header has them. */
  get words(): readonly number[] {
    return [...this.#lanes];
  }

  /** Whether these are the sums. */
  is(words: readonly number[]): boolean {
    return this.#lanes.every((lane, i) => lane === words[i]);
  }
}

/** Whether all words are 0; -0 is something else. */
function isZero({ buffer, byteOffset, length }: Float32Array<ArrayBuffer>): boolean {
  const words = new Uint32Array(buffer, byteOffset, length);
  let i = 0;
  for (const end = length - 7; i < end; i += 8)
    if (
      ((words[i] as number) |
        (words[i + 1] as number) |
        (words[i + 2] as number) |
        (words[i + 3] as number) |
        (words[i + 4] as number) |
        (words[i + 5] as number) |
        (words[i + 6] as number) |
        (words[i + 7] as number)) !==
      0
    )
      return false;
  for (; i < length; i++) if (words[i] !== 0) return false;
  return true;
}

/**
 * A film as bytes, for a file: a header with a checksum, a line of JSON and the sums as they are (at most about
 * `32 × lightPasses + 32` bytes a pixel; sums that are 0 everywhere take none). Little-endian; for this version of Glanz.
 */
export function encodeFilmState(state: FilmState): Uint8Array<ArrayBuffer> {
  const pieces = encodeFilmPieces(state);
  const bytes = new Uint8Array(pieces.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const piece of pieces) {
    bytes.set(piece, at);
    at += piece.length;
  }
  return bytes;
}

/**
 * The bytes of {@link encodeFilmState}, one piece after another, for writers of large files: the sums are not copied.
 *
 * @param withBeauty Whether to include the layer `beauty`, which merging computes from the sums. Default: true.
 */
export function encodeFilmPieces(state: FilmState, withBeauty = true): Uint8Array<ArrayBuffer>[] {
  const { sampling, sums, parts: partial, ...rest } = state;
  const { counts, tiles, sample, pixel, until } = sampling;
  const zero = FILM_SUMS.filter((name) => (name === 'beauty' && !withBeauty) || isZero(sums[name]));
  const head: FilmHead = {
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
  const first = new Uint8Array(HEADER_BYTES + textBytes);
  first.fill(0x20, HEADER_BYTES);
  first.set(text, HEADER_BYTES);
  const pieces = [
    first,
    ...[
      counts,
      ...(tiles ? [tiles] : []),
      ...FILM_SUMS.filter((name) => !zero.includes(name)).map((name) => sums[name]),
      ...partial.map((part) => part.sums),
    ].map(({ buffer, byteOffset, byteLength }) => new Uint8Array(buffer, byteOffset, byteLength)),
  ];
  const checksum = new Checksum();
  for (const piece of pieces) checksum.add(piece === first ? piece.subarray(HEADER_BYTES) : piece);
  const view = new DataView(first.buffer);
  [MAGIC, VERSION, textBytes, ...checksum.words].forEach((word, i) => view.setUint32(4 * i, word, true));
  return pieces;
}

export const DAMAGED = 'they are damaged or cut off: their checksum is another one';

/** The first {@link HEADER_BYTES} of an encoded film: bytes of its JSON, and the checksum of all that follows. */
export function readHeader(bytes: Uint8Array): { readonly textBytes: number; readonly hash: readonly number[] } {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < HEADER_BYTES || view.getUint32(0, true) !== MAGIC) throw broken('they do not begin as one');
  if (view.getUint32(4, true) !== VERSION)
    throw broken(`they are of version ${view.getUint32(4, true)}, and this is version ${VERSION}`);
  const hash = Array.from({ length: LANES }, (_, i) => view.getUint32(12 + 4 * i, true));
  return { textBytes: view.getUint32(8, true), hash };
}

/** @param at Where the numbers begin. @param bytes Of the film. */
export function checkLength(head: FilmHead, at: number, bytes: number): void {
  const lengths = sumLengths(head);
  const words =
    head.counts +
    Math.max(0, head.tiles) +
    FILM_SUMS.reduce((sum, name) => sum + (head.zero.includes(name) ? 0 : lengths[name]), 0) +
    head.parts.length * lengths.film_total;
  if (bytes !== at + 4 * words) throw broken(`they are ${bytes} bytes, and such a film takes ${at + 4 * words}`);
}

/**
 * The film that {@link encodeFilmState} has written.
 * @throws {RenderError} `renderer/film-state` for bytes that are not a film, truncated, damaged, or of another version.
 */
export function decodeFilmState(bytes: Uint8Array): FilmState {
  const { textBytes, hash } = readHeader(bytes);
  // A copy if the words are not aligned in the caller's buffer.
  const body = (bytes.byteOffset % 4 === 0 ? bytes : bytes.slice()).subarray(HEADER_BYTES) as Uint8Array<ArrayBuffer>;
  if (bytes.length % 4 !== 0 || !new Checksum().add(body).is(hash)) throw broken(DAMAGED);
  const head = readHead(bytes.subarray(HEADER_BYTES, HEADER_BYTES + textBytes));
  const lengths = sumLengths(head);
  let at = HEADER_BYTES + textBytes;
  checkLength(head, at, bytes.length);
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

/** The line of JSON. @throws {RenderError} `renderer/film-state` */
export function readHead(text: Uint8Array): FilmHead {
  let head: FilmHead;
  try {
    head = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(text)) as FilmHead;
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

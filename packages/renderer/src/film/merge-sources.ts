import { FILM_CHUNK, type SampleRanges } from '../schedule/sample-range';
import { composeInPlace, readFilmState } from './compose';
import { sumLengths } from './film-check';
import {
  broken,
  checkLength,
  Checksum,
  DAMAGED,
  decodeFilmState,
  HEADER_BYTES,
  readHead,
  readHeader,
  type FilmHead,
} from './film-codec';
import { FILM_SUMS, type FilmState } from './film-state';
import { checkSame, checkSampling, mergeFilmStates, samplingTo, union } from './merge';

/** The bytes of `encodeFilmState` wherever they are, such as in a file. */
export interface FilmSource {
  /** How many they are. */
  readonly bytes: number;
  /** Fills the target with the bytes from a position on. One call at a time. */
  read(target: Uint8Array<ArrayBuffer>, position: number): Promise<void>;
  /** What to throw in place of an error that this source has caused. */
  readonly onError?: ((error: unknown) => Promise<unknown>) | undefined;
}

/** Floats that are read at once of each film. */
const STEP = 2 ** 20;

/** A film that is read in the order of its bytes. */
class FilmReader {
  readonly head: FilmHead;
  readonly #source: FilmSource;
  readonly #expected: readonly number[];
  readonly #checksum: Checksum;
  /** Where the next bytes are. */
  #at: number;

  private constructor(source: FilmSource, first: Uint8Array<ArrayBuffer>, head: FilmHead, expected: readonly number[]) {
    this.#source = source;
    this.head = head;
    this.#expected = expected;
    this.#at = first.length;
    this.#checksum = new Checksum().add(first.subarray(HEADER_BYTES));
  }

  static async open(source: FilmSource): Promise<FilmReader> {
    const start = new Uint8Array(Math.min(HEADER_BYTES, source.bytes));
    await source.read(start, 0);
    const { textBytes, hash } = readHeader(start);
    const length = HEADER_BYTES + textBytes;
    if (textBytes % 4 !== 0 || length > source.bytes) throw broken(DAMAGED);
    const first = new Uint8Array(length);
    await source.read(first, 0);
    const head = readHead(first.subarray(HEADER_BYTES));
    checkLength(head, length, source.bytes);
    return new FilmReader(source, first, head, hash);
  }

  get source(): FilmSource {
    return this.#source;
  }

  has(name: (typeof FILM_SUMS)[number]): boolean {
    return !this.head.zero.includes(name);
  }

  /** Reads the next bytes. */
  async next(target: Uint8Array<ArrayBuffer>): Promise<void> {
    const at = this.#at;
    this.#at += target.length;
    await this.#source.read(target, at);
  }

  /** Counts bytes that {@link next} has read, in their order. */
  count(bytes: Uint8Array<ArrayBuffer>): void {
    this.#checksum.add(bytes);
  }

  end(): void {
    if (!this.#checksum.is(this.#expected)) throw broken(DAMAGED);
  }

  /** Reads all bytes again. @throws {RenderError} `renderer/film-state` if they are not those that were written */
  async check(): Promise<void> {
    const checksum = new Checksum();
    const buffer = new Uint8Array(4 * STEP);
    for (let at = HEADER_BYTES; at < this.#source.bytes; at += buffer.length) {
      const part = buffer.subarray(0, Math.min(buffer.length, this.#source.bytes - at));
      await this.#source.read(part, at);
      checksum.add(part);
    }
    if (!checksum.is(this.#expected)) throw broken(DAMAGED);
  }

  /** The film as a whole. */
  async whole(): Promise<FilmState> {
    const bytes = new Uint8Array(this.#source.bytes);
    await this.#source.read(bytes, 0);
    return decodeFilmState(bytes);
  }
}

/** Runs what concerns one source. */
async function of<T>(source: FilmSource, run: () => T | Promise<T>): Promise<T> {
  try {
    return await run();
  } catch (error) {
    throw source.onError ? await source.onError(error) : error;
  }
}

/** How {@link mergeFilmSources} adds films up. */
export interface MergeOptions {
  /**
   * Whether the image is all that is wanted: `sums.beauty` of the result is that of the whole merge, and its other sums
   * may have no elements, which takes half the memory. Such a film cannot be resumed, saved or merged. Default: false.
   */
  readonly imageOnly?: boolean;
}

/**
 * `mergeFilmStates` of films in files: the same bits, while the files are read, so that memory holds the result alone.
 * Films that have parts of chunks, whose samples do not begin at multiples of 16, are decoded first.
 *
 * @param sources At least one.
 * @throws {RenderError} `renderer/film-state`, as `mergeFilmStates` and `decodeFilmState`
 */
export async function mergeFilmSources(
  sources: readonly FilmSource[],
  { imageOnly = false }: MergeOptions = {},
): Promise<FilmState> {
  const readers: FilmReader[] = [];
  for (const source of sources) readers.push(await of(source, () => FilmReader.open(source)));
  try {
    return await mergeReaders(readers, imageOnly);
  } catch (error) {
    // What a damaged film says of itself does not count.
    for (const reader of readers) await of(reader.source, () => reader.check());
    throw error;
  }
}

async function mergeReaders(readers: readonly FilmReader[], imageOnly: boolean): Promise<FilmState> {
  const sorted = readers
    .filter(({ head }) => head.samples > 0)
    .sort((a, b) => (a.head.ranges[0]?.[0] as number) - (b.head.ranges[0]?.[0] as number));
  for (const { head } of readers) checkSampling({ ...head, tiles: head.tiles < 0 ? undefined : head.tiles });
  for (const { head } of readers) checkSame(head, (readers[0] as FilmReader).head);
  const plan = sorted.length > 1 && sorted.length === readers.length ? planOf(sorted) : undefined;
  if (plan) return merged(sorted, plan, imageOnly);
  const films: FilmState[] = [];
  for (const reader of readers) films.push(await of(reader.source, () => reader.whole()));
  return mergeFilmStates(films);
}

interface MergePlan {
  readonly ranges: SampleRanges;
  readonly end: number;
  /** The film whose last chunk is not whole. */
  readonly open: FilmReader | undefined;
}

/** How films are added up without parts of chunks; `undefined`: they have some. */
function planOf(readers: readonly FilmReader[]): MergePlan | undefined {
  const endOf = ({ head }: FilmReader) => (head.ranges.at(-1) as readonly [number, number])[1];
  const ranges = union(readers.map(({ head }) => head));
  const [, end] = ranges.at(-1) as readonly [number, number];
  const open = readers.filter((reader) => endOf(reader) % FILM_CHUNK > 0);
  const simple =
    readers.every(({ head }) => head.parts.length === 0) &&
    (open.length === 0 || (open.length === 1 && endOf(open[0] as FilmReader) === end));
  return simple ? { ranges, end, open: open[0] } : undefined;
}

async function merged(
  readers: readonly FilmReader[],
  { ranges, end, open }: MergePlan,
  imageOnly: boolean,
): Promise<FilmState> {
  const [{ head: model }] = readers as [FilmReader];
  const lengths = sumLengths(model);
  const [weight, ...others] = model.weights.last;
  // The image of one light group is made of the sums where they are.
  const inPlace = imageOnly && weight !== undefined && others.length === 0 && model.lightPasses === 1;
  for (const reader of readers) await pass([reader], reader.head.counts, () => undefined);
  const sums = {} as Record<(typeof FILM_SUMS)[number], Float32Array<ArrayBuffer>>;
  for (const name of FILM_SUMS) {
    const having = readers.filter((reader) => reader.has(name));
    if (name === 'beauty') {
      await pass(having, lengths[name], () => undefined);
      continue;
    }
    if (name === 'film_moment' && inPlace) {
      const { film_total: total, film_block: block } = sums;
      if (having.length === 0) total.fill(0);
      await pass(having, lengths[name], (moments, at) => composeInPlace(total, block, weight, moments, at));
      continue;
    }
    const out = (sums[name] = new Float32Array(lengths[name]));
    const from = name === 'film_block' ? having.indexOf(open as FilmReader) : undefined;
    const adder = new Adder(out, having.length < readers.length);
    await pass(having, lengths[name], (chunks, at) => {
      if (from === undefined) adder.add(chunks, at);
      else if (from >= 0) out.set(chunks[from] as Float32Array, at);
    });
  }
  for (const reader of readers) await of(reader.source, () => reader.end());
  const { width, height, lightPasses, fingerprint, weights } = model;
  const film: FilmState = {
    width,
    height,
    samples: ranges.reduce((sum, [first, last]) => sum + last - first, 0),
    ranges,
    badSamples: readers.reduce((sum, { head }) => sum + head.badSamples, 0),
    lightPasses,
    fingerprint,
    weights,
    parts: [],
    sampling: samplingTo(end, model.counts),
    sums: { ...sums, beauty: new Float32Array(0) },
  };
  if (!inPlace) return { ...film, sums: { ...sums, beauty: readFilmState(film, 'beauty') } };
  const none = new Float32Array(0);
  return { ...film, sums: { film_block: none, film_total: none, film_moment: none, beauty: sums.film_total } };
}

/** Reads as many floats of each film, and calls back with those of all films, while the next ones are read. */
async function pass(
  readers: readonly FilmReader[],
  length: number,
  use: (chunks: readonly Float32Array[], at: number) => void,
): Promise<void> {
  if (readers.length === 0 || length === 0) return;
  const size = Math.min(STEP, length);
  const buffers = [0, 1].map(() => readers.map(() => new Float32Array(size)));
  const read = (turn: number, at: number) => {
    const chunks = (buffers[turn % 2] as Float32Array<ArrayBuffer>[]).map((one) =>
      one.subarray(0, Math.min(size, length - at)),
    );
    const done = Promise.all(
      chunks.map((chunk, i) => {
        const reader = readers[i] as FilmReader;
        return of(reader.source, () => reader.next(bytesOf(chunk)));
      }),
    );
    // Awaited in the next turn; an error before that is not unhandled.
    done.catch(() => undefined);
    return { chunks, done };
  };
  let next: ReturnType<typeof read> | undefined = read(0, 0);
  for (let at = 0, turn = 1; next; at += size, turn++) {
    const { chunks, done } = next;
    await done;
    next = at + size < length ? read(turn, at + size) : undefined;
    for (const [i, chunk] of chunks.entries()) (readers[i] as FilmReader).count(bytesOf(chunk));
    use(chunks, at);
  }
}

const bytesOf = ({ buffer, byteOffset, byteLength }: Float32Array<ArrayBuffer>) =>
  new Uint8Array(buffer, byteOffset, byteLength);

/** Adds in double precision, in the order of the films, and rounds once. */
class Adder {
  readonly #out: Float32Array;
  #sum: Float64Array | undefined;
  readonly #withZeros: boolean;

  /** @param withZeros Whether some films are 0 everywhere: they make 0 of -0. */
  constructor(out: Float32Array, withZeros: boolean) {
    this.#out = out;
    this.#withZeros = withZeros;
  }

  add(chunks: readonly Float32Array[], at: number): void {
    const out = this.#out;
    const [a, b, c, ...others] = chunks as readonly [Float32Array, ...(Float32Array | undefined)[]];
    const length = a.length;
    const zero = this.#withZeros ? 0 : -0;
    if (!b) {
      for (let i = 0; i < length; i++) out[at + i] = (a[i] as number) + zero;
    } else if (!c) {
      for (let i = 0; i < length; i++) out[at + i] = (a[i] as number) + (b[i] as number) + zero;
    } else if (others.length === 0) {
      for (let i = 0; i < length; i++) out[at + i] = (a[i] as number) + (b[i] as number) + (c[i] as number) + zero;
    } else {
      const sum = (this.#sum ??= new Float64Array(STEP));
      for (let i = 0; i < length; i++) sum[i] = (a[i] as number) + (b[i] as number) + (c[i] as number) + zero;
      for (const other of others as readonly Float32Array[])
        for (let i = 0; i < length; i++) sum[i] = (sum[i] as number) + (other[i] as number);
      for (let i = 0; i < length; i++) out[at + i] = sum[i] as number;
    }
  }
}

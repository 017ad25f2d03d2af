import { describe, expect, it } from 'vitest';
import {
  encodeFilmPieces,
  encodeFilmState,
  mergeFilmSources,
  mergeFilmStates,
  readFilmState,
  type FilmSource,
  type FilmState,
} from '../../src/film';

// mergeFilmStates(), which has the films in memory, is the reference; it is tested against tracers.
let seed = 1;
const random = () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) / 2 ** 32;

interface FilmOptions {
  readonly width?: number;
  readonly lightPasses?: number;
  readonly groups?: number;
  /** Leaves a sum at 0. */
  readonly zero?: readonly (keyof FilmState['sums'])[];
}

/** A film with samples from the first to the one after the last, with the parts of chunks that such a film has. */
function filmOf(first: number, end: number, options: FilmOptions = {}): FilmState {
  const { width = 7, lightPasses = 1, groups = lightPasses, zero = [] } = options;
  const pixel = 4 * width * 3;
  const sums = (length: number) => Float32Array.from({ length }, () => 100 * random() * random());
  const moment = sums(pixel);
  for (let i = 3; i < pixel; i += 4) moment[i] = end - first;
  const made = {
    film_block: end % 16 === 0 ? new Float32Array(lightPasses * pixel) : sums(lightPasses * pixel),
    film_total: sums(lightPasses * pixel),
    film_moment: moment,
    beauty: sums(pixel),
  };
  for (const name of zero) made[name].fill(0);
  const weights = Array.from({ length: groups }, (_, i) => [1, 0.5 + i, 0.25] as const);
  return {
    width,
    height: 3,
    samples: end - first,
    ranges: [[first, end]],
    badSamples: first,
    lightPasses,
    fingerprint: 'f',
    weights: { first: weights, last: weights },
    parts: first % 16 === 0 ? [] : [{ chunk: Math.floor(first / 16), sums: sums(lightPasses * pixel) }],
    sampling: { counts: Uint32Array.of(end, end), tiles: undefined, sample: end, pixel: 0, until: 0 },
    sums: made,
  };
}

const sourceOf = (film: FilmState, withBeauty = true, change: (bytes: Uint8Array) => void = () => undefined) => {
  const pieces = encodeFilmPieces(film, withBeauty);
  const bytes = new Uint8Array(Buffer.concat(pieces));
  change(bytes);
  const reads: [number, number][] = [];
  const source: FilmSource = {
    bytes: bytes.length,
    async read(target, position) {
      reads.push([position, target.length]);
      if (position + target.length > bytes.length) throw new Error('beyond the end');
      target.set(bytes.subarray(position, position + target.length));
    },
  };
  return { source, reads };
};

const code = { code: 'renderer/film-state' };

describe('films that are merged while they are read', () => {
  it.each<[string, FilmState[]]>([
    ['two', [filmOf(0, 32), filmOf(32, 64)]],
    ['three, in another order, the last chunk not whole', [filmOf(48, 85), filmOf(0, 16), filmOf(16, 48)]],
    ['five', [0, 1, 2, 3, 4].map((i) => filmOf(16 * i, 16 * i + 16))],
    ['with a gap', [filmOf(0, 16), filmOf(64, 96), filmOf(96, 112)]],
    ['with light groups', [filmOf(0, 16, { lightPasses: 3 }), filmOf(16, 20, { lightPasses: 3 })]],
    ['with catchers', [0, 1].map((i) => filmOf(16 * i, 16 * i + 16, { lightPasses: 4, groups: 1 }))],
    ['one of them black', [filmOf(0, 16, { zero: ['film_total', 'film_moment'] }), filmOf(16, 32), filmOf(32, 48)]],
    ['all of them black', [0, 1].map((i) => filmOf(16 * i, 16 * i + 16, { zero: ['film_total'] }))],
    ['that split chunks', [filmOf(0, 10), filmOf(10, 40), filmOf(40, 47)]],
    ['one', [filmOf(0, 40)]],
    ['one with samples, one without', [filmOf(0, 40), filmOf(0, 0)]],
  ])('%s: the same film bit for bit', async (_, films) => {
    const merged = await mergeFilmSources(films.map((film) => sourceOf(film).source));
    const expected = mergeFilmStates(films);
    expect(merged).toEqual(expected);
    expect(Buffer.compare(encodeFilmState(merged), encodeFilmState(expected))).toBe(0);
    // The image alone is the same, with less memory where it is made in place.
    const { sums, ...rest } = await mergeFilmSources(
      films.map((film) => sourceOf(film).source),
      { imageOnly: true },
    );
    expect({ ...rest, sums: expected.sums }).toEqual(expected);
    expect(Buffer.compare(Buffer.from(sums.beauty.buffer), Buffer.from(expected.sums.beauty.buffer))).toBe(0);
  });

  it('for their image alone: without the sums that it is made of', async () => {
    const films = [0, 1].map((i) => filmOf(16 * i, 16 * i + 16, { width: 90_000 }));
    const { sums } = await mergeFilmSources(
      films.map((film) => sourceOf(film, false).source),
      { imageOnly: true },
    );
    expect([sums.film_block.length, sums.film_total.length, sums.film_moment.length]).toEqual([0, 0, 0]);
    expect(
      Buffer.compare(Buffer.from(sums.beauty.buffer), Buffer.from(mergeFilmStates(films).sums.beauty.buffer)),
    ).toBe(0);
  });

  it('without their beauty, which the result has', async () => {
    const films = [filmOf(0, 16), filmOf(16, 32)];
    const merged = await mergeFilmSources(films.map((film) => sourceOf(film, false).source));
    expect(merged).toEqual(mergeFilmStates(films));
    expect(merged.sums.beauty).toEqual(readFilmState(merged, 'beauty'));
  });

  it('larger than what is read at once: each byte once, but for the header', async () => {
    // 2^20 floats are read at once.
    const films = [0, 1].map((i) => filmOf(16 * i, 16 * i + 16, { width: 90_000 }));
    const sources = films.map((film) => sourceOf(film));
    const merged = await mergeFilmSources(sources.map(({ source }) => source));
    const expected = mergeFilmStates(films);
    for (const name of ['film_total', 'film_moment', 'beauty'] as const)
      expect(Buffer.compare(Buffer.from(merged.sums[name].buffer), Buffer.from(expected.sums[name].buffer))).toBe(0);
    for (const { source, reads } of sources) {
      const [header, first, ...rest] = reads as [[number, number], [number, number], ...[number, number][]];
      expect([header, first[0]]).toEqual([[0, 28], 0]);
      let at = first[1];
      for (const [position, length] of rest) {
        expect(position).toBe(at);
        at += length;
      }
      expect(at).toBe(source.bytes);
      expect(rest.length).toBeGreaterThan(3);
    }
  });

  it('are refused as mergeFilmStates refuses them', async () => {
    const film = filmOf(0, 16);
    for (const films of [
      [],
      [film, film],
      [film, filmOf(16, 32, { width: 8 })],
      [film, { ...filmOf(16, 32), fingerprint: 'g' }],
      [film, { ...filmOf(16, 32), sampling: { ...film.sampling, pixel: 3 } }],
      [film, { ...filmOf(16, 32), sampling: { ...film.sampling, tiles: Uint32Array.of(0) } }],
    ] as FilmState[][]) {
      const why = await mergeFilmSources(films.map((one) => sourceOf(one).source)).catch((error: Error) => error);
      expect(why).toMatchObject(code);
      expect(() => mergeFilmStates(films)).toThrow((why as Error).message);
    }
  });

  it('with a byte changed anywhere are refused, by the error that their source makes of it', async () => {
    const other = sourceOf(filmOf(16, 32)).source;
    const film = filmOf(0, 16);
    const length = encodeFilmState(film).length;
    let tried = 0;
    for (let at = 0; at < length; at += at < 420 ? 3 : 37) {
      const { source } = sourceOf(film, true, (bytes) => void (bytes[at] = (bytes[at] as number) ^ (1 << (at % 8))));
      const onError = async (error: unknown) => Object.assign(error as Error, { mine: true });
      const error: unknown = await mergeFilmSources([other, { ...source, onError }]).catch((why: unknown) => why);
      expect(error, `byte ${at}`).toMatchObject(code);
      // Of a header that can be read, what differs from the other film comes first.
      if (at > 420) expect(error, `byte ${at}`).toMatchObject({ mine: true });
      tried++;
    }
    expect(tried).toBeGreaterThan(150);
  });
});

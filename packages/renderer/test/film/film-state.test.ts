import { describe, expect, it } from 'vitest';
import { decodeFilmState, encodeFilmState, type FilmState } from '../../src/film';

const state = (tiles?: Uint32Array<ArrayBuffer>): FilmState => {
  const sums = (length: number) => Float32Array.from({ length }, (_, i) => (i === 3 ? Infinity : 0.1 * i - 1));
  return {
    width: 9,
    height: 2,
    lightPasses: 3,
    samples: 17,
    ranges: [[3, 20]],
    badSamples: 2,
    fingerprint: 'äbc',
    weights: { first: [[1, 1, 1]], last: [[0.5, 0, 2]] },
    parts: [{ chunk: 0, sums: sums(4 * 18 * 3) }],
    sampling: { counts: Uint32Array.of(17, 16), tiles, sample: 16, pixel: 5, until: 96 },
    sums: {
      film_block: sums(4 * 18 * 3),
      film_total: sums(4 * 18 * 3),
      film_moment: sums(4 * 18),
      beauty: sums(4 * 18),
    },
  };
};

/** FNV-1a over little-endian words. */
function fnv(bytes: Uint8Array): number {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let hash = 0x811c9dc5;
  for (let at = 0; at < bytes.length; at += 4) hash = Math.imul(hash ^ view.getUint32(at, true), 0x01000193);
  return hash >>> 0;
}

describe('a film as bytes', () => {
  it.each([undefined, Uint32Array.of(1)])('comes back as it was (tiles: %s)', (tiles) => {
    expect(decodeFilmState(encodeFilmState(state(tiles)))).toEqual(state(tiles));
  });

  it('takes no bytes for sums that are 0 everywhere', () => {
    const full = state();
    const { film_block: block, beauty } = full.sums;
    const sums = { ...full.sums, film_block: new Float32Array(block.length), beauty: new Float32Array(beauty.length) };
    const some = { ...full, sums };
    expect(decodeFilmState(encodeFilmState(some))).toEqual(some);
    const saved = encodeFilmState(full).length - encodeFilmState(some).length;
    // But for their names in the header.
    expect(Math.abs(saved - block.byteLength - beauty.byteLength)).toBeLessThan(40);
    sums.beauty[5] = -0;
    expect(Object.is(decodeFilmState(encodeFilmState(some)).sums.beauty[5], -0)).toBe(true);
  });

  it('is read from the middle of a larger buffer', () => {
    const bytes = encodeFilmState(state());
    const larger = new Uint8Array(bytes.length + 3);
    larger.set(bytes, 3);
    expect(decodeFilmState(larger.subarray(3))).toEqual(state());
  });

  it('is refused when it is cut off anywhere, or longer', () => {
    const bytes = encodeFilmState(state());
    const typed = expect.objectContaining({ code: 'renderer/film-state' }) as Error;
    for (let length = 0; length < bytes.length; length += 7)
      expect(() => decodeFilmState(bytes.subarray(0, length))).toThrow(typed);
    expect(() => decodeFilmState(Uint8Array.from([...bytes, 0, 0, 0, 0]))).toThrow(typed);
  });

  it('is refused with any byte changed', () => {
    const bytes = encodeFilmState(state());
    const typed = expect.objectContaining({ code: 'renderer/film-state' }) as Error;
    for (let at = 0; at < bytes.length; at++) {
      const damaged = bytes.slice();
      damaged[at] = (damaged[at] as number) ^ (1 << (at % 8));
      expect(() => decodeFilmState(damaged), `byte ${at}`).toThrow(typed);
    }
  });

  it('is refused, or read, but never fails otherwise with a header that was changed', () => {
    const bytes = encodeFilmState(state());
    for (let at = 0; at < 360; at++) {
      for (const value of [0, 0x22, 0x39, 0x7d, 0xff]) {
        const forged = bytes.slice();
        forged[at] = value;
        new DataView(forged.buffer).setUint32(12, fnv(forged.subarray(16)), true);
        try {
          decodeFilmState(forged);
        } catch (error) {
          expect((error as { code?: string }).code, `byte ${at} as ${value}: ${String(error)}`).toBe(
            'renderer/film-state',
          );
        }
      }
    }
  });
});

import { createHash } from 'node:crypto';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import {
  decodeFilmState,
  encodeFilmPieces,
  mergeFilmSources,
  readFilmState,
  type FilmState,
} from '@glanz/renderer/film';
import { describe, expect, it } from 'vitest';
import { readFilmFile, writeFilmFile } from '../src/render/film-file';

const codec = async () => ({
  encode: encodeFilmPieces,
  decode: decodeFilmState,
  merge: mergeFilmSources,
  layer: readFilmState,
});

/** A film whose sums take more bytes than are hashed at once. */
function film(): FilmState {
  const [width, height] = [1200, 1000];
  const sums = (scale: number) => Float32Array.from({ length: 4 * width * height }, (_, i) => scale * (1 + (i % 977)));
  return {
    width,
    height,
    samples: 16,
    ranges: [[0, 16]],
    badSamples: 0,
    lightPasses: 1,
    fingerprint: 'f',
    weights: { first: [[1, 1, 1]], last: [[1, 1, 1]] },
    parts: [],
    sampling: { counts: Uint32Array.of(16, 16), tiles: undefined, sample: 16, pixel: 0, until: 0 },
    sums: {
      film_block: new Float32Array(4 * width * height),
      film_total: sums(0.1),
      film_moment: sums(0.3),
      beauty: sums(0.7),
    },
  };
}

describe('writeFilmFile', () => {
  it('hashes the bytes that it writes, if it is asked to', async () => {
    const folder = mkdtempSync(join(tmpdir(), 'glanz-film-'));
    const state = film();
    const written = await writeFilmFile('a.film', folder, state, { '--width': '1200' }, codec, { hashed: true });
    const bytes = readFileSync(join(folder, 'a.film'));
    expect(written).toEqual({ bytes: bytes.length, sha256: createHash('sha256').update(bytes).digest('hex') });
    expect(await writeFilmFile('b.film', folder, state, { '--width': '1200' }, codec)).toEqual({ bytes: bytes.length });
    expect(Buffer.compare(readFileSync(join(folder, 'b.film')), bytes)).toBe(0);
    const fail = (why = 'foreign') => new Error(why);
    const read = await readFilmFile(join(folder, 'a.film'), codec, { foreign: fail, broken: fail });
    expect(Buffer.compare(Buffer.from(read!.film.sums.beauty.buffer), Buffer.from(state.sums.beauty.buffer))).toBe(0);
    rmSync(folder, { recursive: true });
  });
});

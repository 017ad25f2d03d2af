import { describe, expect, it } from 'vitest';
import { decodeEnvironment, encodeExr, encodeHdr, ImageError } from '../src/index';
import { hasShared, shared } from './shared';

describe('decodeEnvironment', () => {
  it('tells HDR from EXR by the first bytes', () => {
    const data = Float32Array.of(1, 2, 4, 0.5, 0.25, 0);
    expect([...decodeEnvironment(encodeHdr({ width: 2, height: 1, data })).data]).toEqual([...data]);
    const exr = encodeExr({ width: 2, height: 1, layers: [{ name: '', channels: { R: Float32Array.of(1, 0.5), G: Float32Array.of(2, 0.25), B: Float32Array.of(4, 0) } }] });
    const image = decodeEnvironment(exr);
    expect([...image.data]).toEqual([...data]);
    expect(image.warnings).toEqual([]);
    expect(() => decodeEnvironment(Uint8Array.of(1, 2, 3, 4, 5))).toThrow(ImageError);
    expect(() => decodeEnvironment(new Uint8Array(0))).toThrow(/neither/);
  });
  it('takes grey from Y, and names the channels when there is no colour', () => {
    expect([...decodeEnvironment(encodeExr({ width: 1, height: 1, layers: [{ name: '', channels: { Y: Float32Array.of(3) } }] })).data]).toEqual([3, 3, 3]);
    expect(() => decodeEnvironment(encodeExr({ width: 1, height: 1, layers: [{ name: 'depth', channels: { Z: Float32Array.of(3) } }] }))).toThrow(/only depth\.Z/);
  });
  it('makes radiance of NaN, infinities and negatives, and says so', () => {
    const exr = encodeExr({ width: 1, height: 1, layers: [{ name: '', type: 'float', channels: { R: Float32Array.of(NaN), G: Float32Array.of(Infinity), B: Float32Array.of(-1) } }] });
    const image = decodeEnvironment(exr);
    expect([...image.data]).toEqual([0, 3.4028234663852886e38, 0]);
    expect(image.warnings[0]?.message).toMatch(/3 negative or non-finite/);
  });
});

interface BadFile {
  readonly file: string;
  readonly kind: string;
  readonly expect: string;
  readonly alsoOk?: readonly string[];
  readonly why: string;
  readonly stored?: boolean;
}

describe.skipIf(!hasShared)(`${hasShared ? '' : '[skipped: ../shared is absent] '}the corpus of bad environments`, () => {
  const list = hasShared ? (JSON.parse(new TextDecoder().decode(shared('bad/index.json'))) as BadFile[]).filter((e) => e.kind === 'env' && e.stored !== false) : [];

  it('holds what it should', () => {
    expect(list.length).toBeGreaterThan(100);
  });
  it('every file ends as labelled: no hang, no raw error, no number that is not radiance', () => {
    for (const entry of list) {
      const bytes = shared(`bad/${entry.file}`);
      const started = performance.now();
      let outcome: string;
      try {
        const image = decodeEnvironment(bytes);
        expect(image.data.every((v) => v >= 0 && v < Infinity), entry.file).toBe(true);
        outcome = image.warnings.length > 0 ? 'accept-with-warning' : 'accept';
      } catch (error) {
        if (!(error instanceof ImageError)) throw new Error(`${entry.file}: raw error`, { cause: error });
        expect(error.message).not.toMatch(/\n/);
        outcome = 'reject';
      }
      expect([entry.expect, ...(entry.alsoOk ?? [])], `${entry.file} (${entry.why})`).toContain(outcome);
      expect(performance.now() - started, entry.file).toBeLessThan(5000);
    }
  });
});

import { describe, expect, it } from 'vitest';
import { ToneMapError, srgbDecode, srgbEncode, toneMap, toneMapPixels } from '../src/index';
import { srgbByteEncoder } from '../src/srgb';

describe('sRGB', () => {
  it('has the points of IEC 61966-2-1', () => {
    expect(srgbEncode(0.0031308)).toBeCloseTo(0.04045, 5);
    expect(srgbEncode(0.5)).toBeCloseTo(0.735357, 6);
    expect(srgbEncode(0.18)).toBeCloseTo(0.461356, 6);
    expect(srgbDecode(128 / 255)).toBeCloseTo(0.215861, 6);
  });
  it('round-trips all 256 codes', () => {
    for (let i = 0; i < 256; i++) expect(Math.round(srgbEncode(srgbDecode(i / 255)) * 255)).toBe(i);
  });
  it('clamps, and writes NaN as 0', () => {
    expect([srgbEncode(-1), srgbEncode(NaN), srgbEncode(7), srgbDecode(NaN), srgbDecode(2)]).toEqual([0, 0, 1, 0, 1]);
  });
});

describe('bytes by a table', () => {
  it('are those of the power, at the limits between codes too', () => {
    const encode = srgbByteEncoder();
    const truth = (v: number) => Math.floor(255 * srgbEncode(v) + 0.5);
    const values = Array.from({ length: 100_000 }, (_, i) => (i - 10) / 99_000);
    for (let k = 1; k < 256; k++) {
      const limit = srgbDecode((k - 0.5) / 255);
      for (let ulp = -40; ulp <= 40; ulp++) values.push(limit * (1 + ulp * Number.EPSILON));
    }
    values.push(NaN, Infinity, -Infinity, Number.MIN_VALUE, 1 - Number.EPSILON);
    for (const v of values) if (encode(v) !== truth(v)) expect.unreachable(`${v}: ${encode(v)}, not ${truth(v)}`);
  });
});

describe('toneMap', () => {
  it('one stop of exposure is a doubling', () => {
    expect(toneMap([0.2, 0.1, 0.05], { toneMap: 'aces', exposure: 1 })).toEqual(
      toneMap([0.4, 0.2, 0.1], { toneMap: 'aces' }),
    );
  });
  it('linear is the bare sRGB curve', () => {
    expect(toneMap([0.5, 0.18, 0], { toneMap: 'linear' })).toEqual([srgbEncode(0.5), srgbEncode(0.18), 0]);
  });
  it('defaults to neutral', () => {
    expect(toneMap([0.5, 0.5, 0.5])[0]).toBeCloseTo(srgbEncode(0.46), 12);
  });
});

describe('toneMapPixels', () => {
  it('divides by alpha before the curve and keeps alpha', () => {
    const film = new Float32Array([0.25, 0.125, 0.0625, 0.5, 0.5, 0.25, 0.125, 1]);
    const out = toneMapPixels(film, 2, 1, { toneMap: 'agx' });
    expect([...out.subarray(0, 3)]).toEqual([...out.subarray(4, 7)]);
    expect(out[3]).toBe(128);
    expect(out[7]).toBe(255);
  });
  it('opaque ignores alpha', () => {
    expect([...toneMapPixels(new Float32Array([1, 1, 1, 0]), 1, 1, { toneMap: 'linear', alpha: 'opaque' })]).toEqual([
      255, 255, 255, 255,
    ]);
  });
  it('writes 8 bits, 16 bits and floats of the same image', () => {
    const film = new Float32Array([0.5, 0.18, 0.02, 1]);
    const float = toneMapPixels(film, 1, 1, { toneMap: 'linear', output: 'float' });
    const u8 = toneMapPixels(film, 1, 1, { toneMap: 'linear' });
    const u16 = toneMapPixels(film, 1, 1, { toneMap: 'linear', output: 'uint16' });
    expect([u8 instanceof Uint8ClampedArray, u16 instanceof Uint16Array, float instanceof Float32Array]).toEqual([
      true,
      true,
      true,
    ]);
    for (let i = 0; i < 4; i++) {
      expect(u8[i]).toBe(Math.round((float[i] as number) * 255));
      expect(u16[i]).toBe(Math.round((float[i] as number) * 65535));
    }
  });
  it('gives black, not garbage, for pixels that are not numbers', () => {
    const film = new Float32Array([NaN, NaN, NaN, NaN, NaN, 1, 1, 1, Infinity, 1, 1, 1]);
    expect([...toneMapPixels(film, 3, 1, { toneMap: 'linear' })]).toEqual([
      0, 0, 0, 0, 0, 255, 255, 255, 255, 255, 255, 255,
    ]);
  });
  it('checks the size', () => {
    expect(() => toneMapPixels(new Float32Array(15), 2, 2)).toThrow(ToneMapError);
    expect(() => toneMapPixels(new Float32Array(4), 0.5, 2)).toThrow(/0.5×2/);
  });
});

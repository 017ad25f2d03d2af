import { describe, expect, it } from 'vitest';
import { cameraExposure, exposureValue, ToneMapError } from '../src/index';

describe('exposureValue', () => {
  // The scale of exposure values (ISO 2720): aperture √2^k and time 2^−m make EV k + m. "f/2.8 at 1/60" are rounded
  // names.
  it.each([
    ['f/1', 0, '1 s', 0],
    ['f/2.8', 3, '1/60 s', 6],
    ['f/8', 6, '1/250 s', 8],
    ['f/16', 8, '1/125 s', 7],
    ['f/2', 2, '30 s', -5],
  ])('%s (√2^%i) at %s', (_, k, _time, m) => {
    expect(exposureValue({ fStop: Math.SQRT2 ** k, shutter: 2 ** -m })).toBeCloseTo(k + m, 10);
  });
  it('sensitivity counts in stops: ISO 400 needs two fewer', () => {
    expect(exposureValue({ fStop: 4, shutter: 0.01, iso: 400 })).toBeCloseTo(
      exposureValue({ fStop: 4, shutter: 0.01 }) - 2,
      12,
    );
  });
});

describe('cameraExposure', () => {
  it('makes the luminance that saturates the sensor 1: L = 78/(0.65 · S) · N²/t', () => {
    for (const [fStop, shutter, iso] of [
      [8, 1 / 125, 100],
      [2.8, 1 / 30, 800],
    ] as const) {
      const saturating = (78 / (0.65 * iso)) * ((fStop * fStop) / shutter);
      expect(saturating * 2 ** cameraExposure({ fStop, shutter, iso })).toBeCloseTo(1, 10);
    }
  });
  it.each([
    { fStop: 0, shutter: 1 },
    { fStop: 8, shutter: -1 },
    { fStop: 8, shutter: 1, iso: Number.NaN },
  ])('refuses %j', (settings) => {
    expect(() => cameraExposure(settings)).toThrow(ToneMapError);
  });
});

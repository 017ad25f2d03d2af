import { describe, expect, it } from 'vitest';
import { linearToYcxcz, srgbToLinear, ycxczToLinear } from '../../src/flip/colour';
import { flip } from '../../src/flip/flip';
import { featureFilters, filterPlane, sensitivityFilters } from '../../src/flip/kernels';

const [W, H] = [96, 64];

function image(f: (x: number, y: number) => readonly [number, number, number]): Float32Array {
  const out = new Float32Array(3 * W * H);
  for (let y = 0; y < H; y++) for (let x = 0; x < W; x++) out.set(f(x, y), 3 * (y * W + x));
  return out;
}
const waves = (x: number, y: number) =>
  [
    0.5 + 0.4 * Math.sin(x * 0.21 + 0.1 * y),
    0.5 + 0.3 * Math.cos(y * 0.33),
    0.5 + 0.45 * Math.sin((x + y) * 0.12),
  ] as const;
const REFERENCE = image(waves);

function noisy(): Float32Array {
  let state = 7;
  return REFERENCE.map((value) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.min(Math.max(value + 0.3 * ((state >>> 8) / 2 ** 24 - 0.5), 0), 1);
  });
}

type Rgb = readonly [number, number, number];
const constant = (...rgb: Rgb) => Float32Array.from({ length: 3 * 16 * 16 }, (_, i) => rgb[i % 3]!);

describe('agreement with the published implementation (flip-evaluator 1.7), means at two viewing distances', () => {
  const cases: readonly (readonly [string, Float32Array, number, number])[] = [
    ['noise', noisy(), 0.17377, 0.314712],
    ['a shift by two pixels', image((x, y) => waves((x - 2 + W) % W, y)), 0.322058, 0.324163],
    ['four fifths of the brightness', REFERENCE.map((v) => v * 0.8), 0.567276, 0.547439],
    [
      'a red box',
      image((x, y) => (x >= 30 && x < 60 && y >= 20 && y < 40 ? [0.9, 0.1, 0.1] : waves(x, y))),
      0.115066,
      0.099171,
    ],
    ['white dots', image((x, y) => (x % 16 === 10 && y % 16 === 10 ? [1, 1, 1] : waves(x, y))), 0.027876, 0.017547],
  ];
  it.each(cases)('%s', (_, test, near, far) => {
    expect(flip(REFERENCE, test, W, H).mean).toBeCloseTo(near, 4);
    expect(flip(REFERENCE, test, W, H, { pixelsPerDegree: 30 }).mean).toBeCloseTo(far, 4);
  });
  const uniform: readonly (readonly [Rgb, Rgb, number])[] = [
    [[0, 0, 0], [1, 1, 1], 0.967391],
    [[0.5, 0.5, 0.5], [0.6, 0.5, 0.4], 0.32608],
    [[1, 0, 0], [0, 1, 0], 0.986664],
  ];
  it.each(uniform)('uniform images %j and %j', (a, b, value) => {
    expect(flip(constant(...a), constant(...b), 16, 16).mean).toBeCloseTo(value, 4);
  });
  it('single pixels of the map', () => {
    const { map } = flip(REFERENCE, noisy(), W, H);
    expect(map[12 * W + 33]).toBeCloseTo(0.18988, 3);
    expect(Math.max(...map)).toBeCloseTo(0.47658, 3);
  });
});

describe('what the definition says', () => {
  it('is 0 for equal images and 1 for green beside blue, the largest difference there is', () => {
    expect(flip(REFERENCE, REFERENCE, W, H).mean).toBe(0);
    expect(flip(constant(0, 1, 0), constant(0, 0, 1), 16, 16).mean).toBeCloseTo(1, 9);
  });
  it('is symmetric, and grows with noise', () => {
    const noise = noisy();
    const half = REFERENCE.map((value, i) => (value + noise[i]!) / 2);
    const whole = flip(REFERENCE, noise, W, H).mean;
    expect(flip(noise, REFERENCE, W, H).mean).toBeCloseTo(whole, 12);
    expect(flip(REFERENCE, half, W, H).mean).toBeLessThan(0.8 * whole);
  });
  it('stays within 0..1 for images of extremes', () => {
    const extremes = image((x, y) => [(x * 7 + y) % 2, (x + y * 3) % 2, (x >> 1) % 2] as const);
    for (const value of flip(REFERENCE, extremes, W, H).map) expect(value >= 0 && value <= 1).toBe(true);
  });
  it('rejects images of other sizes', () => {
    expect(() => flip(REFERENCE, constant(0, 0, 0), W, H)).toThrow(RangeError);
  });
});

describe('parts', () => {
  it('colours come back from the opponent space', () => {
    for (const rgb of [
      [0, 0, 0],
      [1, 1, 1],
      [0.2, 0.7, 0.1],
    ] as readonly Rgb[])
      ycxczToLinear(...linearToYcxcz(...rgb)).forEach((value, c) => expect(value).toBeCloseTo(rgb[c]!, 12));
    expect(srgbToLinear(0.5)).toBeCloseTo(0.21404114, 8);
  });
  it('white is achromatic with Y 100', () => {
    const [y, cx, cz] = linearToYcxcz(1, 1, 1);
    expect(y).toBeCloseTo(100, 10);
    expect(Math.hypot(cx, cz)).toBeLessThan(1e-10);
  });
  it('sensitivity filters keep a uniform plane; detectors give 0 on it, and 1 on the sharpest edge at its foot', () => {
    const plane = new Float64Array(W * H).fill(3);
    for (const terms of sensitivityFilters(67))
      expect(
        terms.reduce((sum, { weight, taps }) => sum + weight * filterPlane(plane, W, H, taps, taps)[W * 30 + 40]!, 0),
      ).toBeCloseTo(3, 10);
    const { blur, edge, point } = featureFilters(67);
    expect(filterPlane(plane, W, H, edge, blur)[W * 30 + 40]).toBeCloseTo(0, 10);
    expect(filterPlane(plane, W, H, point, blur)[W * 30 + 40]).toBeCloseTo(0, 10);
    const step = Float64Array.from({ length: W * H }, (_, i) => (i % W > 40 ? 1 : 0));
    expect(Math.abs(filterPlane(step, W, H, edge, blur)[W * 30 + 40]!)).toBeCloseTo(1, 10);
  });
});

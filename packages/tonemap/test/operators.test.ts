import { describe, expect, it } from 'vitest';
import {
  REINHARD_WHITE,
  TONE_MAPS,
  ToneMapError,
  agxToneMap,
  acesToneMap,
  linearToneMap,
  neutralToneMap,
  reinhardToneMap,
  toneMapOperator,
  type Rgb,
  type ToneMap,
} from '../src/index';

const luminance = ([r, g, b]: Rgb) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
/** Twenty stops either way of white in eighths of a stop. */
const STOPS = Array.from({ length: 321 }, (_, i) => 2 ** ((i - 160) / 8));
const CHROMATICITIES: Rgb[] = [
  [1, 1, 1],
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
  [1, 0.5, 0.1],
  [0.2, 0.9, 1],
  [0.7, 0.1, 0.9],
];

describe.each(TONE_MAPS)('every tone map: %s', (name) => {
  const { map } = toneMapOperator(name);

  it('never falls as a grey gets brighter, keeps it grey, and spans 0 to 1', () => {
    let last = -1;
    for (const v of STOPS) {
      const [r, g, b] = map([v, v, v]);
      expect(g).toBeGreaterThanOrEqual(last);
      expect(Math.max(Math.abs(r - g), Math.abs(b - g)), `grey ${v} → ${r} ${g} ${b}`).toBeLessThan(1e-3);
      last = g;
    }
    expect(map([0, 0, 0])).toEqual([0, 0, 0]);
    expect(map([1e6, 1e6, 1e6])[1]).toBeGreaterThan(0.999);
  });

  it('keeps every colour inside 0..1 and its luminance from falling with exposure', () => {
    for (const c of CHROMATICITIES) {
      let last = -1;
      for (const v of STOPS) {
        const out = map([c[0] * v, c[1] * v, c[2] * v]);
        for (const x of out) expect(x >= 0 && x <= 1, `${c} × ${v} → ${out}`).toBe(true);
        expect(luminance(out), `${c} × ${v}`).toBeGreaterThanOrEqual(last - 1e-12);
        last = luminance(out);
      }
    }
  });

  it('gives defined numbers for NaN, infinities and negatives', () => {
    const odd = [NaN, Infinity, -Infinity, -1, -0, 1e38, 5e-324, 0.5];
    for (const r of odd)
      for (const g of odd) for (const b of odd) for (const x of map([r, g, b])) expect(x >= 0 && x <= 1).toBe(true);
    expect(map([NaN, NaN, NaN])).toEqual([0, 0, 0]);
    expect(map([Infinity, Infinity, Infinity])[0]).toBeGreaterThan(0.999);
  });
});

it('refuses a name it does not know', () => {
  expect(() => toneMapOperator('filmic' as ToneMap)).toThrow(ToneMapError);
  expect(() => toneMapOperator('constructor' as ToneMap)).toThrow(/Known: neutral, aces/);
});

describe('Khronos PBR Neutral', () => {
  it('reproduces base colours less F90 wherever 0.08 ≤ c ≤ 0.8 (the specification’s guarantee)', () => {
    for (const r of [0.08, 0.2, 0.5, 0.8])
      for (const g of [0.08, 0.33, 0.8])
        for (const b of [0.081, 0.4, 0.79]) {
          const out = neutralToneMap([r, g, b]);
          expect(out[0]).toBeCloseTo(r - 0.04, 12);
          expect(out[1]).toBeCloseTo(g - 0.04, 12);
          expect(out[2]).toBeCloseTo(b - 0.04, 12);
        }
  });

  it('is undone by the analytic inverse of the specification’s formula', () => {
    const inverse = (out: Rgb): Rgb => {
      const pn = Math.max(...out);
      let base: number[] = [...out];
      if (pn > 0.76) {
        const p = 0.24 ** 2 / (1 - pn) - 1 + 2 * 0.76;
        const g = 1 / (0.15 * (p - pn) + 1);
        base = out.map((c) => ((c - pn * (1 - g)) / g) * (p / pn));
      }
      const y = Math.max(Math.min(...base), 0); // rounding may leave -1e-17
      const f = y <= 0.04 ? 2 * Math.sqrt(0.04 * y) - y : 0.04;
      return [(base[0] as number) + f, (base[1] as number) + f, (base[2] as number) + f];
    };
    for (const c of CHROMATICITIES)
      for (const v of [0.01, 0.07, 0.3, 0.8, 0.85, 2, 10, 60]) {
        const input: Rgb = [c[0] * v, c[1] * v, c[2] * v];
        const back = inverse(neutralToneMap(input));
        for (const k of [0, 1, 2] as const)
          expect(Math.abs(back[k] - input[k]), `${input}[${k}]`).toBeLessThan(1e-7 * (1 + v));
      }
  });

  it('turns bright saturated light towards white, as the specification asks', () => {
    const [r, g] = neutralToneMap([1000, 0, 0]);
    expect(r).toBeGreaterThan(0.999);
    expect(g).toBeGreaterThan(0.99);
  });
});

describe('ACES', () => {
  it('shows 18 % grey at a tenth of white, the anchor of the ACES sRGB output', () => {
    expect(acesToneMap([0.18, 0.18, 0.18])[1]).toBeCloseTo(0.1, 1.8);
  });
  it('keeps to the fit’s own values on the grey axis', () => {
    // Rational fit computed with exact fractions; the matrices' rows add up to 1 within 1e-5.
    expect(acesToneMap([1, 1, 1])[1]).toBeCloseTo(1.024488063 / 1.654762, 3);
    expect(acesToneMap([0.18, 0.18, 0.18])[1]).toBeCloseTo(0.036733611 / 0.347884992, 3);
  });
  it('desaturates strong primaries (no pure channel survives)', () => {
    const [r, g, b] = acesToneMap([20, 0, 0]);
    expect(r).toBe(1);
    expect(Math.min(g, b)).toBeGreaterThan(0.05);
  });
});

describe('AgX', () => {
  it('brings middle grey to code 0.5 of its 2.2 display', () => {
    for (const x of agxToneMap([0.18, 0.18, 0.18])) expect(x).toBeCloseTo(0.5 ** 2.2, 3);
  });
  it('is black ten stops below middle grey and white 6.5 above', () => {
    expect(agxToneMap([0.18 / 1024, 0.18 / 1024, 0.18 / 1024])[1]).toBeLessThan(1e-5);
    expect(agxToneMap([0.18 * 2 ** 6.5, 0.18 * 2 ** 6.5, 0.18 * 2 ** 6.5])[1]).toBeGreaterThan(0.999);
  });
  it('has the entries of the published table (LUTs/AgX_Default_Contrast.spi1d, 4096 entries)', () => {
    for (const [index, code] of [
      [4076, 0.9986303],
      [4080, 0.9989231],
      [4085, 0.9992857],
      [4090, 0.9996447],
      [4094, 0.9999292],
    ] as const) {
      const v = 0.18 * 2 ** ((index / 4095) * 16.5 - 10);
      // The matrices' rows miss 1 by 1e-4, which moves a grey by 1e-5 on this axis.
      expect(agxToneMap([v, v, v])[1] ** (1 / 2.2)).toBeCloseTo(code, 3.7);
    }
  });
  it('stays within 0.006 of the published polynomial fit of that table', () => {
    // Sixth order, by B. Wrensch, "Minimal AgX implementation".
    const polynomial = (x: number) =>
      15.5 * x ** 6 - 40.14 * x ** 5 + 31.96 * x ** 4 - 6.868 * x ** 3 + 0.4298 * x ** 2 + 0.1191 * x - 0.00232;
    for (let x = 0; x <= 1; x += 1 / 512) {
      const v = 0.18 * 2 ** (x * 16.5 - 10);
      expect(Math.abs(agxToneMap([v, v, v])[1] ** (1 / 2.2) - polynomial(x)), `at ${x}`).toBeLessThan(0.006);
    }
  });
});

describe('Reinhard', () => {
  it('has the points of equation 4', () => {
    expect(reinhardToneMap([REINHARD_WHITE, REINHARD_WHITE, REINHARD_WHITE])[0]).toBeCloseTo(1, 12);
    expect(reinhardToneMap([1, 1, 1])[0]).toBeCloseTo((1 + 1 / 16) / 2, 12);
  });
  it('keeps the ratios of channels', () => {
    const [r, g, b] = reinhardToneMap([0.6, 0.3, 0.15]);
    expect(r / g).toBeCloseTo(2, 12);
    expect(g / b).toBeCloseTo(2, 12);
  });
});

it('linear only clips', () => {
  expect(linearToneMap([0.25, 1, 3])).toEqual([0.25, 1, 1]);
});

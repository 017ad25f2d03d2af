import { describe, expect, it } from 'vitest';
import {
  OPENPBR_PARAMETERS,
  resolveParameters,
  validateParameters,
  type OpenPbrParameterName,
} from '../src/parameters/index';
import { OPENPBR_PRESET_NAMES, OPENPBR_PRESETS, openPbrPreset } from '../src/presets/index';
import { presets as shared } from './oracle/index';

type Matrix = number[][];
const inverse = (m: Matrix): Matrix => {
  const [a, b, c, d, e, f, g, h, i] = m.flat() as [
    number,
    number,
    number,
    number,
    number,
    number,
    number,
    number,
    number,
  ];
  const det = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
  return [
    [e * i - f * h, c * h - b * i, b * f - c * e],
    [f * g - d * i, a * i - c * g, c * d - a * f],
    [d * h - e * g, b * g - a * h, a * e - b * d],
  ].map((row) => row.map((x) => x / det));
};
const times = (a: Matrix, b: Matrix): Matrix =>
  a.map((row) => b[0]!.map((_, j) => row.reduce((sum, x, k) => sum + x * b[k]![j]!, 0)));
const xyz = ([x, y]: readonly [number, number]) => [x / y, 1, (1 - x - y) / y];
/** RGB to XYZ of primaries and white given as chromaticities. */
const toXyz = (primaries: readonly (readonly [number, number])[], white: readonly [number, number]): Matrix => {
  const p = [0, 1, 2].map((row) => primaries.map((primary) => xyz(primary)[row]!));
  const scale = times(
    inverse(p),
    xyz(white).map((x) => [x]),
  );
  return p.map((row) => row.map((x, j) => x * scale[j]![0]!));
};
const D60 = [0.32168, 0.33767] as const,
  D65 = [0.3127, 0.329] as const;
const BRADFORD = [
  [0.8951, 0.2664, -0.1614],
  [-0.7502, 1.7135, 0.0367],
  [0.0389, -0.0685, 1.0296],
];
const cone = (white: readonly [number, number]) =>
  times(
    BRADFORD,
    xyz(white).map((x) => [x]),
  ).map(([x]) => x!);
const adapt = times(
  inverse(BRADFORD),
  times(
    [0, 1, 2].map((i) => [0, 1, 2].map((j) => (i === j ? cone(D65)[i]! / cone(D60)[i]! : 0))),
    BRADFORD,
  ),
);
/** ACEScg to linear Rec.709, from the definitions of both. */
const TO_REC709 = times(
  inverse(
    toXyz(
      [
        [0.64, 0.33],
        [0.3, 0.6],
        [0.15, 0.06],
      ],
      D65,
    ),
  ),
  times(
    adapt,
    toXyz(
      [
        [0.713, 0.293],
        [0.165, 0.83],
        [0.128, 0.044],
      ],
      D60,
    ),
  ),
);

describe('OPENPBR_PRESETS', () => {
  it('are the 83 examples, within the ranges of their parameters', () => {
    expect(OPENPBR_PRESET_NAMES.length).toBe(83);
    for (const name of OPENPBR_PRESET_NAMES)
      expect(validateParameters(OPENPBR_PRESETS[name]), name).toEqual({
        parameters: OPENPBR_PRESETS[name],
        warnings: [],
      });
  });

  it("are the specification's numbers, with colours in Rec.709", () => {
    const theirs = shared();
    expect(Object.keys(theirs)).toEqual([...OPENPBR_PRESET_NAMES]);
    for (const name of OPENPBR_PRESET_NAMES) {
      const ours = resolveParameters(OPENPBR_PRESETS[name]) as unknown as Record<string, number | number[]>;
      for (const [parameter, value] of Object.entries(theirs[name]!) as [OpenPbrParameterName, unknown][]) {
        const { type, range } = OPENPBR_PARAMETERS[parameter];
        if (type !== 'color3') {
          expect(ours[parameter]).toBe(value);
          continue;
        }
        const color = times(
          TO_REC709,
          (value as number[]).map((x) => [x]),
        ).map(([x]) => x!);
        (ours[parameter] as number[]).forEach((component, k) => {
          if (parameter === 'subsurface_radius_scale')
            expect(component * (ours['subsurface_radius'] as number)).toBeCloseTo(Math.max(color[k]!, 0), 6);
          else expect(component).toBeCloseTo(Math.min(Math.max(color[k]!, range![0]), range![1]), 6);
        });
      }
    }
  });

  it('keep greys grey', () => {
    for (const component of OPENPBR_PRESETS.gray_card.base_color!) expect(component).toBeCloseTo(0.18, 9);
  });

  it('are frozen', () => {
    expect(Object.isFrozen(OPENPBR_PRESETS) && Object.isFrozen(OPENPBR_PRESETS.gold)).toBe(true);
  });
});

describe('openPbrPreset', () => {
  it('scales what is a length', () => {
    expect(openPbrPreset('gold')).toEqual(OPENPBR_PRESETS.gold);
    expect(openPbrPreset('blood', { unit: 0.01 })).toEqual({ ...OPENPBR_PRESETS.blood, transmission_depth: 0.0008 });
    expect(openPbrPreset('skin_i', { unit: 0.01 }).subsurface_radius).toBe(0.01);
    expect(openPbrPreset('petroleum', { unit: 0.01 }).subsurface_radius).toBeCloseTo(
      0.01 * OPENPBR_PRESETS.petroleum.subsurface_radius!,
      12,
    );
  });
});

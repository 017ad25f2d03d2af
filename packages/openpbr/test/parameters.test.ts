import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import {
  defaultParameters,
  OPENPBR_PARAMETER_NAMES,
  OPENPBR_PARAMETERS,
  OpenPbrError,
  resolveParameters,
  validateParameters,
} from '../src/parameters/index';
import { presets } from './oracle/index';

describe('parameter table', () => {
  it('holds the 41 parameters of OpenPBR 1.1.1, and three of the draft of 1.2 that do nothing by default', () => {
    const draft = OPENPBR_PARAMETER_NAMES.filter((name) => OPENPBR_PARAMETERS[name].draft);
    expect(draft).toEqual(['specular_haze', 'specular_haze_spread', 'specular_retroreflectivity']);
    expect(draft.map((name) => OPENPBR_PARAMETERS[name].default)).toEqual([0, 0.3, 0]);
    expect(OPENPBR_PARAMETER_NAMES).toHaveLength(44);
    for (const name of OPENPBR_PARAMETER_NAMES) expect(OPENPBR_PARAMETERS[name].name).toBe(name);
  });

  it('has consistent entries', () => {
    for (const info of Object.values(OPENPBR_PARAMETERS)) {
      expect(info.name.startsWith(info.group)).toBe(true);
      expect(info.doc).toMatch(/^[A-Z].*\.$/);
      if (info.type === 'boolean' || info.type === 'vector3') {
        expect(info.range).toBeUndefined();
        continue;
      }
      const { range, softRange } = info;
      if (!range || !softRange) throw new Error(`${info.name} has no range`);
      expect(range[0]).toBeLessThanOrEqual(softRange[0]);
      expect(range[1]).toBeGreaterThanOrEqual(softRange[1]);
      for (const value of [info.default].flat() as number[]) {
        expect(value).toBeGreaterThanOrEqual(softRange[0]);
        expect(value).toBeLessThanOrEqual(softRange[1]);
      }
    }
  });

  it('says the same as the docstrings of the type', () => {
    const source = readFileSync(new URL('../src/parameters/types.ts', import.meta.url), 'utf8');
    // As one line each, however they are wrapped.
    const text = source.replace(/\s+(\* )?/g, ' ');
    for (const info of Object.values(OPENPBR_PARAMETERS))
      expect(text).toContain(`/** ${info.doc} */ readonly ${info.name}:`);
  });

  it('is frozen', () => {
    expect(Object.isFrozen(OPENPBR_PARAMETERS)).toBe(true);
    expect(Object.isFrozen(OPENPBR_PARAMETERS.base_color.default)).toBe(true);
  });

  it('accepts every example material of the specification', () => {
    for (const [name, material] of Object.entries(presets())) {
      const { warnings } = validateParameters(material);
      // In the specification's own examples edge tints reach 1.013 (before conversion from ACEScg) and radius scales
      // 1.842.
      const excused = ['specular_color', 'subsurface_radius_scale'];
      expect(
        warnings.filter((w) => w.code !== 'openpbr/clamped' || !excused.includes(w.parameter)),
        name,
      ).toEqual([]);
    }
  });
});

describe('validateParameters', () => {
  it('clamps and says so', () => {
    const { parameters, warnings } = validateParameters({
      specular_roughness: 1.7,
      base_color: [-1, 0.5, 3],
      emission_color: [5, 0, 0],
    });
    expect(parameters).toEqual({ specular_roughness: 1, base_color: [0, 0.5, 1], emission_color: [5, 0, 0] });
    expect(warnings.map((w) => [w.code, w.parameter])).toEqual([
      ['openpbr/clamped', 'specular_roughness'],
      ['openpbr/clamped', 'base_color'],
      ['openpbr/clamped', 'base_color'],
    ]);
  });

  it('replaces what is not finite by the default', () => {
    const { parameters, warnings } = validateParameters({ specular_ior: Number.NaN, specular_weight: Infinity });
    expect(parameters).toEqual({ specular_ior: 1.5, specular_weight: 1 });
    expect(warnings.map((w) => w.code)).toEqual(['openpbr/not-finite', 'openpbr/not-finite']);
  });

  it('ignores unknown names aloud', () => {
    const { parameters, warnings } = validateParameters({ base_colour: [1, 1, 1] } as never);
    expect(parameters).toEqual({});
    expect(warnings[0]?.code).toBe('openpbr/unknown-parameter');
  });

  it.each([
    { base_color: 1 },
    { base_weight: [1, 1, 1] },
    { geometry_thin_walled: 1 },
    { base_color: [1, 1] },
    { base_color: ['a', 0, 0] },
    { base_color: null },
    { base_weight: '1' },
  ])('refuses %j', (bad) => {
    expect(() => validateParameters(bad as never)).toThrow(OpenPbrError);
  });

  it('gives vectors length 1, and none to those without a direction', () => {
    const { parameters, warnings } = validateParameters({
      geometry_normal: [0, 3, 4],
      geometry_tangent: [0, 0, 0],
      geometry_coat_normal: [Number.NaN, 0, 2],
      geometry_coat_tangent: [0.6, 0.8, 0],
    });
    expect(parameters).toEqual({
      geometry_normal: [0, 0.6, 0.8],
      geometry_tangent: null,
      geometry_coat_normal: [0, 0, 1],
      geometry_coat_tangent: [0.6, 0.8, 0],
    });
    expect(warnings.map((w) => [w.code, w.parameter])).toEqual([
      ['openpbr/no-direction', 'geometry_tangent'],
      ['openpbr/not-finite', 'geometry_coat_normal'],
    ]);
  });

  it('accepts every parameter at both ends of its range, and no further', () => {
    for (const { name, type, range } of Object.values(OPENPBR_PARAMETERS)) {
      if (!range) continue;
      const of = (value: number) => ({ [name]: type === 'float' ? value : [value, value, value] }) as never;
      for (const [end, beyond] of [
        [range[0], range[0] - 1],
        [range[1], range[1] + 1],
      ] as const) {
        if (!Number.isFinite(end)) continue;
        expect(validateParameters(of(end))).toEqual({ parameters: of(end), warnings: [] });
        const { parameters, warnings } = validateParameters(of(beyond));
        expect(parameters).toEqual(of(end));
        expect(new Set(warnings.map((w) => `${w.code} ${w.parameter}`))).toEqual(new Set([`openpbr/clamped ${name}`]));
      }
    }
  });

  it('takes typed arrays for colours and null for vectors', () => {
    expect(
      validateParameters({ base_color: new Float64Array([0.1, 0.2, 0.3]), geometry_normal: null } as never).parameters,
    ).toEqual({ base_color: [0.1, 0.2, 0.3], geometry_normal: null });
  });
});

describe('resolveParameters', () => {
  it('fills in the defaults', () => {
    expect(resolveParameters()).toEqual(defaultParameters());
    expect(resolveParameters({ coat_weight: 2 })).toEqual({ ...defaultParameters(), coat_weight: 1 });
  });
});

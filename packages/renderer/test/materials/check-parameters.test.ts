import { describe, expect, it } from 'vitest';
import { checkParameters } from '../../src/materials/check-parameters';

const refused = (parameters: object): string => {
  try {
    checkParameters('paint', parameters);
  } catch (error) {
    expect(error).toMatchObject({ code: 'renderer/material' });
    return (error as Error).message;
  }
  return 'accepted';
};

describe('checkParameters', () => {
  it('accepts what OpenPBR allows, its limits included', () => {
    for (const parameters of [
      {},
      { base_color: [0, 1, 0.5] },
      { specular_roughness: 0 },
      { specular_roughness: 1 },
      { emission_luminance: 1e6 },
      { geometry_thin_walled: true },
      { geometry_normal: null },
    ]) {
      expect(refused(parameters)).toBe('accepted');
    }
  });

  it('names the parameter that was meant', () => {
    expect(refused({ base_colour: [1, 0, 0] })).toContain('did you mean "base_color"');
    expect(refused({ roughness: 0.5 })).toContain('has no parameter "roughness"');
    expect(refused({ qwertyuiop: 1 })).not.toContain('did you mean');
  });

  it.each<object>([
    { specular_roughness: 1.7 },
    { base_weight: -0.1 },
    { base_color: [0.5, 0.5, 1.01] },
    { specular_ior: 0 },
  ])('refuses %j, which is out of range', (parameters) => {
    expect(refused(parameters)).toMatch(/it must be finite and from/);
  });

  it.each([NaN, Infinity, -Infinity])('refuses %s, alone and in a colour', (value) => {
    expect(refused({ coat_weight: value })).toContain(`coat_weight is ${value}`);
    expect(refused({ emission_color: [1, value, 1] })).toContain('emission_color');
  });

  it.each<object>([
    { coat_weight: '1' },
    { base_color: 0.5 },
    { base_color: [1, 2] },
    { geometry_thin_walled: 1 },
    { geometry_normal: [0, 0, 0] },
  ])('refuses %j, which is of another kind', (parameters) => {
    expect(refused(parameters)).not.toBe('accepted');
  });
});

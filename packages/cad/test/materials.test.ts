import { OPENPBR_PRESETS } from '@glanz/openpbr/presets';
import { describe, expect, it } from 'vitest';
import { CadError, checkMaterialMap, hexOf } from '../src/index';
import { materialOf } from '../src/materials';

const MAP = checkMaterialMap({
  rules: [
    { part: '*/rod-assembly/*', preset: 'gold' },
    { part: 'b?lt', preset: 'brass' },
    { part: 'BOLT*', preset: 'brass', parameters: { specular_roughness: 0.3 }, name: 'fasteners' },
    { color: '#00ff00', parameters: { base_metalness: 1 }, keepColor: true },
  ],
  fallback: { parameters: { base_color: [0.1, 0.1, 0.1] } },
});

describe('rules', () => {
  it('by path, by name whatever its case, by colour; the first that fits', () => {
    expect(materialOf(MAP, 'nut', ['as1', 'rod-assembly'], undefined)).toEqual({
      name: 'gold',
      parameters: OPENPBR_PRESETS.gold,
    });
    const bolt = materialOf(MAP, 'bolt 3', ['as1'], [0, 0, 1]);
    expect(bolt).toEqual({ name: 'fasteners', parameters: { ...OPENPBR_PRESETS.brass, specular_roughness: 0.3 } });
    expect(materialOf(MAP, 'plate', [], [0.0005, 1, 0])).toEqual({
      name: 'CAD #02ff00',
      parameters: { base_metalness: 1, base_color: [0.0005, 1, 0] },
    });
    expect(materialOf(MAP, 'plate', [], [0, 0.5, 0]).parameters).toEqual({ base_color: [0.1, 0.1, 0.1] });
  });

  it('a pattern holds nothing but stars: other signs stand for themselves', () => {
    expect(materialOf(MAP, 'bolt', [], undefined).name).toBe('fasteners');
    expect(materialOf(MAP, 'b?lt', [], undefined).name).toBe('brass');
  });

  it('without a map the colours of the file are kept', () => {
    expect(materialOf(undefined, 'x', [], [1, 0, 0])).toEqual({
      name: 'CAD #ff0000',
      parameters: { specular_roughness: 0.4, base_color: [1, 0, 0] },
    });
  });
});

it('colours of the file are linear, those of a map sRGB', () => {
  expect(hexOf([1, 0.2158605, 0])).toBe('#ff8000');
});

it.each([
  [null, '/'],
  [{}, '/rules'],
  [{ rules: [{}] }, '/rules/0'],
  [{ rules: [{ part: 3 }] }, '/rules/0/part'],
  [{ rules: [{ part: 'a', color: 'red' }] }, '/rules/0/color'],
  [{ rules: [{ part: 'a', preset: 'unobtainium' }] }, '/rules/0/preset'],
  [{ rules: [{ part: 'a', colour: '#000000' }] }, '/rules/0/colour'],
  [{ rules: [], fallback: { parameters: { base_colour: 1 } } }, '/fallback/parameters'],
])('an invalid map: %j', (json, path) => {
  try {
    checkMaterialMap(json);
    expect.unreachable();
  } catch (error) {
    expect(error).toBeInstanceOf(CadError);
    expect((error as CadError).location?.path).toBe(path);
  }
});

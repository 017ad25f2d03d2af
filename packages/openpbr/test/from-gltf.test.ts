import { describe, expect, it } from 'vitest';
import { coatedBase } from '../src/cpu/index';
import { fromGltf } from '../src/gltf/index';
import { resolveParameters } from '../src/parameters/index';

describe('KHR_materials_clearcoat', () => {
  const coated = (clearcoat: Record<string, unknown>, others: Record<string, unknown> = {}) => fromGltf({ pbrMetallicRoughness: { metallicFactor: 0 }, extensions: { KHR_materials_clearcoat: clearcoat, ...others } });

  it('becomes a clear coat of index 1.5 without reflections inside', () => {
    expect(coated({ clearcoatFactor: 0.5, clearcoatRoughnessFactor: 0.2 })).toMatchObject({ coat_weight: 0.5, coat_roughness: 0.2, coat_ior: 1.5, coat_darkening: 0 });
    expect(coated({ clearcoatFactor: 1 })).toMatchObject({ coat_weight: 1, coat_roughness: 0 });
  });

  it('without a factor is none, as glTF has it', () => {
    expect(coated({ clearcoatRoughnessFactor: 0.3 })).toEqual(coated({}));
    expect(coated({})).not.toHaveProperty('coat_weight');
  });

  it('leaves the base the reflectance that it has in air', () => {
    for (const clearcoatFactor of [0.25, 0.5, 1]) {
      expect(coatedBase(resolveParameters(coated({ clearcoatFactor }))).specular_ior).toBeCloseTo(1.5, 12);
      expect(coatedBase(resolveParameters(coated({ clearcoatFactor }, { KHR_materials_ior: { ior: 1.8 } }))).specular_ior).toBeCloseTo(1.8, 12);
    }
    // The factor is not the whole coverage.
    expect(coated({ clearcoatFactor: 1, clearcoatTexture: { index: 0 } })).not.toHaveProperty('specular_ior');
  });

  it('does not change what KHR_materials_specular starts from', () => {
    const specular = { KHR_materials_specular: { specularFactor: 0.5, specularColorFactor: [2, 1, 1] } };
    expect(coated({ clearcoatFactor: 1 }, specular).specular_weight).toBe(coated({}, specular).specular_weight);
  });
});

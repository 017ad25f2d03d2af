import { struct } from '@glanz/wgsl';
import type { OpenPbrParameters } from '../parameters/index';

/**
 * The WGSL struct `OpenPbrParameters`: the parameters that the shader modules read, under the specification's names.
 * Put it into a storage or uniform buffer, multiply textured fields by their texels, and hand it to `openpbr_prepare`.
 * A colour and the number that scales it share 16 bytes.
 */
export const openPbrStruct = /* @__PURE__ */ struct('OpenPbrParameters', {
  base_color: 'vec3f',
  base_weight: 'f32',
  specular_color: 'vec3f',
  specular_weight: 'f32',
  emission_color: 'vec3f',
  emission_luminance: 'f32',
  transmission_color: 'vec3f',
  transmission_weight: 'f32',
  base_diffuse_roughness: 'f32',
  base_metalness: 'f32',
  specular_roughness: 'f32',
  specular_roughness_anisotropy: 'f32',
  specular_ior: 'f32',
  geometry_opacity: 'f32',
  transmission_depth: 'f32',
  /** 1 for a thin wall, else 0. */
  geometry_thin_walled: 'u32',
  coat_color: 'vec3f',
  coat_weight: 'f32',
  coat_roughness: 'f32',
  coat_roughness_anisotropy: 'f32',
  coat_ior: 'f32',
  coat_darkening: 'f32',
});

/**
 * Writes a material's parameters into a buffer of {@link openPbrStruct} records.
 *
 * @param buffer From `openPbrStruct.allocate(count)`, or any buffer with that layout.
 * @param index Which record.
 * @param parameters Resolved parameters ({@link resolveParameters}): values are written as they are.
 */
export function packOpenPbr(buffer: ArrayBuffer, index: number, parameters: OpenPbrParameters): void {
  openPbrStruct.write(buffer, index, {
    base_color: parameters.base_color,
    base_weight: parameters.base_weight,
    specular_color: parameters.specular_color,
    specular_weight: parameters.specular_weight,
    emission_color: parameters.emission_color,
    emission_luminance: parameters.emission_luminance,
    transmission_color: parameters.transmission_color,
    transmission_weight: parameters.transmission_weight,
    base_diffuse_roughness: parameters.base_diffuse_roughness,
    base_metalness: parameters.base_metalness,
    specular_roughness: parameters.specular_roughness,
    specular_roughness_anisotropy: parameters.specular_roughness_anisotropy,
    specular_ior: parameters.specular_ior,
    geometry_opacity: parameters.geometry_opacity,
    transmission_depth: parameters.transmission_depth,
    geometry_thin_walled: parameters.geometry_thin_walled ? 1 : 0,
    coat_color: parameters.coat_color,
    coat_weight: parameters.coat_weight,
    coat_roughness: parameters.coat_roughness,
    coat_roughness_anisotropy: parameters.coat_roughness_anisotropy,
    coat_ior: parameters.coat_ior,
    coat_darkening: parameters.coat_darkening,
  });
}

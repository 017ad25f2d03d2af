import { struct } from '@glanz/wgsl';
import {
  OPENPBR_PARAMETER_NAMES,
  type OpenPbrColor,
  type OpenPbrParameterName,
  type OpenPbrParameters as Parameters,
  type OpenPbrVector,
} from '../parameters/index';

/**
 * The WGSL struct `OpenPbrParameters`: every parameter, under the specification's names. Put it into a storage or
 * uniform buffer, multiply textured fields by their texels, and hand it to `openpbr_prepare`. A colour or vector and a
 * number share 16 bytes; a field that a shader's lobes do not read costs it nothing but the memory. The parameters of the
 * draft of 1.2 share one word, in steps of 1/1023.
 */
export const openPbrStruct = /* @__PURE__ */ struct(
  'OpenPbrParameters',
  {
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
    transmission_scatter: 'vec3f',
    transmission_scatter_anisotropy: 'f32',
    subsurface_color: 'vec3f',
    subsurface_weight: 'f32',
    subsurface_radius_scale: 'vec3f',
    subsurface_radius: 'f32',
    fuzz_color: 'vec3f',
    fuzz_weight: 'f32',
    /** Unit vectors in the surface's frame; unperturbed (0, 0, 1) and (1, 0, 0). */
    geometry_normal: 'vec3f',
    fuzz_roughness: 'f32',
    geometry_tangent: 'vec3f',
    thin_film_weight: 'f32',
    geometry_coat_normal: 'vec3f',
    thin_film_thickness: 'f32',
    geometry_coat_tangent: 'vec3f',
    thin_film_ior: 'f32',
    transmission_dispersion_scale: 'f32',
    transmission_dispersion_abbe_number: 'f32',
    subsurface_scatter_anisotropy: 'f32',
    /** `specular_haze`, `specular_haze_spread` and `specular_retroreflectivity`, ten bits each; in programs that draw them. */
    specular_lobes: 'u32',
  },
  { specular_lobes: 'OPENPBR_LOBES' },
);

/** The module of {@link openPbrStruct}, by the name that shaders import. */
export const OpenPbrParameters = openPbrStruct.module;

/** What `null` stands for. */
const UNPERTURBED: Partial<Record<OpenPbrParameterName, OpenPbrVector>> = {
  geometry_normal: [0, 0, 1],
  geometry_tangent: [1, 0, 0],
  geometry_coat_normal: [0, 0, 1],
  geometry_coat_tangent: [1, 0, 0],
};

/**
 * Writes a material's parameters into a buffer of {@link openPbrStruct} records.
 *
 * @param buffer From `openPbrStruct.allocate(count)`, or any buffer with that layout.
 * @param index Which record.
 * @param parameters Resolved parameters ({@link resolveParameters}): values are written as they are.
 */
export function packOpenPbr(buffer: ArrayBuffer, index: number, parameters: Parameters): void {
  const values: Partial<Record<OpenPbrParameterName, number | OpenPbrColor>> = {};
  for (const name of OPENPBR_PARAMETER_NAMES) {
    const value = parameters[name] ?? UNPERTURBED[name] ?? 0;
    values[name] = typeof value === 'boolean' ? Number(value) : value;
  }
  const { specular_haze, specular_haze_spread, specular_retroreflectivity, ...rest } = values;
  const lobes = [specular_haze, specular_haze_spread, specular_retroreflectivity] as number[];
  openPbrStruct.write(buffer, index, {
    ...rest,
    specular_lobes: lobes.reduce((word, value, i) => word | (Math.round(1023 * value) << (10 * i)), 0),
  });
}

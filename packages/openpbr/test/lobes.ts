/** Parameters that switch lobes on, with values that do and values that do it in part. */
export const LOBES = {
  base_weight: [0],
  base_diffuse_roughness: [0.5],
  base_metalness: [1, 0.5],
  specular_weight: [0],
  specular_ior: [0.9, 1.05],
  specular_roughness_anisotropy: [0.5],
  transmission_weight: [1, 0.5],
  subsurface_weight: [0.5],
  geometry_thin_walled: [true],
  coat_weight: [1],
  coat_ior: [0.8],
  geometry_coat_normal: [[0, 0, 1]],
  thin_film_weight: [1],
  fuzz_weight: [1],
  emission_luminance: [1],
} as const;

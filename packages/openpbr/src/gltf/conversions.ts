/**
 * The formulas between glTF and OpenPBR that are more than a product. They are applied to factors, and texel by texel
 * where textures drive them.
 */

const lerp = (a: number, b: number, t: number): number => a + (b - a) * t;

/** Reflectance at normal incidence of an interface, and the index of refraction that has it. */
export const reflectanceOf = (ior: number): number => ((ior - 1) / (ior + 1)) ** 2;
export const iorOf = (reflectance: number): number => (1 + Math.sqrt(reflectance)) / (1 - Math.sqrt(reflectance));

/**
 * Roughness of the LTC sheen (Zeltner, Burley and Chiang 2022) whose directional albedo is closest to that of glTF's
 * sheen of roughness r: within 0.05 for 0.4 to 0.5, 0.1 for 0.3 to 0.7, 0.15 up to 1; below 0.2 glTF's sheen gains
 * energy.
 */
export function fuzzRoughness(r: number): number {
  return 0.164 + 0.906 * r - 0.281 * r * r;
}

/**
 * glTF's anisotropic slopes α_t = lerp(r², 1, s²) and α_b = r² as OpenPBR's pair of roughness and anisotropy, which has
 * α_t² + α_b² = 2 roughness⁴ and α_b = (1 - anisotropy) α_t. Exact.
 */
export function anisotropicRoughness(
  roughness: number,
  strength: number,
): { readonly roughness: number; readonly anisotropy: number } {
  const across = roughness * roughness;
  const along = lerp(across, 1, strength * strength);
  return {
    roughness: Math.sqrt(Math.sqrt((along * along + across * across) / 2)),
    anisotropy: along > 0 ? 1 - across / along : 0,
  };
}

/**
 * Single-scattering albedo of a medium whose half space returns the part `multiple` of what enters it, without an
 * interface (Kulla and Conty 2017), as KHR_materials_volume_scatter states it.
 */
export function singleScatteringAlbedo(multiple: number): number {
  const s = 4.09712 + 4.20863 * multiple - Math.sqrt(9.59217 + 41.6808 * multiple + 17.7126 * multiple * multiple);
  return Math.min(Math.max(1 - s * s, 0), 1);
}

/** The largest reflectance at normal incidence that an index stands for: 1 would be infinite. */
export const LARGEST_REFLECTANCE = 0.98;

import type { Material } from '@glanz/scene';
import { resolveParameters } from '@glanz/openpbr/parameters';

/** A glTF material and the extensions that it uses. */
export interface WrittenMaterial {
  readonly json: Record<string, unknown>;
  readonly extensions: readonly string[];
}

/**
 * The glTF material that is closest to an OpenPBR material: metallic-roughness, index, specular weight and colour,
 * coat, fuzz as sheen, film, transmission with absorption, emission, opacity. Subsurface scattering becomes its colour;
 * textures are not written.
 */
export function toGltfMaterial({ name, parameters, double_sided }: Material): WrittenMaterial {
  const p = resolveParameters(parameters);
  const extensions: Record<string, unknown> = {};
  const mixed = [0, 1, 2].map((k) => {
    const base = p.base_weight * (p.base_color[k] as number);
    return base + p.subsurface_weight * (1 - p.base_metalness) * ((p.subsurface_color[k] as number) - base);
  });
  const clear = p.transmission_weight > 0;
  // glTF's base colour tints transmitted light.
  const base = clear && !(p.transmission_depth > 0) ? [...p.transmission_color] : mixed;
  const json: Record<string, unknown> = {
    name,
    pbrMetallicRoughness: {
      baseColorFactor: [...base.map((x) => Math.min(Math.max(x, 0), 1)), p.geometry_opacity],
      metallicFactor: p.base_metalness,
      roughnessFactor: p.specular_roughness,
    },
    ...(p.geometry_opacity < 1 ? { alphaMode: 'BLEND' } : {}),
    ...(double_sided ? { doubleSided: true } : {}),
  };
  if (p.specular_ior !== 1.5) extensions['KHR_materials_ior'] = { ior: Math.max(p.specular_ior, 1) };
  if (p.base_metalness < 1 && (p.specular_weight !== 1 || p.specular_color.some((c) => c !== 1)))
    extensions['KHR_materials_specular'] = {
      specularFactor: Math.min(p.specular_weight, 1),
      specularColorFactor: [...p.specular_color],
    };
  if (p.coat_weight > 0)
    extensions['KHR_materials_clearcoat'] = {
      clearcoatFactor: p.coat_weight,
      clearcoatRoughnessFactor: p.coat_roughness,
    };
  if (p.fuzz_weight > 0)
    extensions['KHR_materials_sheen'] = {
      sheenColorFactor: p.fuzz_color.map((c) => c * p.fuzz_weight),
      sheenRoughnessFactor: p.fuzz_roughness,
    };
  if (p.thin_film_weight > 0)
    extensions['KHR_materials_iridescence'] = {
      iridescenceFactor: p.thin_film_weight,
      iridescenceIor: p.thin_film_ior,
      iridescenceThicknessMaximum: p.thin_film_thickness * 1000,
    };
  if (p.specular_roughness_anisotropy > 0)
    extensions['KHR_materials_anisotropy'] = { anisotropyStrength: p.specular_roughness_anisotropy };
  if (clear) {
    extensions['KHR_materials_transmission'] = { transmissionFactor: p.transmission_weight };
    if (!p.geometry_thin_walled)
      extensions['KHR_materials_volume'] = {
        thicknessFactor: 1,
        ...(p.transmission_depth > 0
          ? { attenuationDistance: p.transmission_depth, attenuationColor: [...p.transmission_color] }
          : {}),
      };
  }
  if (p.emission_luminance > 0) {
    json['emissiveFactor'] = p.emission_color.map((c) => Math.min(c, 1));
    if (p.emission_luminance !== 1)
      extensions['KHR_materials_emissive_strength'] = { emissiveStrength: p.emission_luminance };
  }
  if (Object.keys(extensions).length > 0) json['extensions'] = extensions;
  return { json, extensions: Object.keys(extensions) };
}

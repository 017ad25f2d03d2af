import type { Document, ExtensionProperty, Material as GltfMaterial } from '@gltf-transform/core';
import {
  KHRMaterialsAnisotropy,
  KHRMaterialsClearcoat,
  KHRMaterialsDiffuseTransmission,
  KHRMaterialsDispersion,
  KHRMaterialsEmissiveStrength,
  KHRMaterialsIOR,
  KHRMaterialsIridescence,
  KHRMaterialsSheen,
  KHRMaterialsSpecular,
  KHRMaterialsTransmission,
  KHRMaterialsVolume,
} from '@gltf-transform/extensions';
import type { Material } from '@glanz/scene';

type Colour = [number, number, number];
type Parameters = Material['parameters'];

const color = (values: readonly [number, number, number] | undefined): Colour => [...(values ?? [1, 1, 1])] as Colour;

/** Any thickness says that a surface encloses a volume; a path tracer measures the thickness itself. */
const THICKNESS = 0.01;

/** Roughness and strength in glTF whose slopes are those of OpenPBR's roughness and anisotropy; see `from-gltf.ts`. */
function anisotropic(roughness: number, anisotropy: number): { roughness: number; strength: number } {
  const along = roughness * roughness * Math.sqrt(2 / (1 + (1 - anisotropy) ** 2));
  const across = (1 - anisotropy) * along;
  return { roughness: Math.sqrt(across), strength: Math.sqrt((along - across) / (1 - across)) };
}

/** Inverse of the fit 0.164 + 0.906 r − 0.281 r² of OpenPBR's fuzz to glTF's sheen. */
function sheenRoughness(fuzz: number): number {
  return Math.min(Math.max((0.906 - Math.sqrt(0.906 ** 2 - 4 * 0.281 * (fuzz - 0.164))) / (2 * 0.281), 0), 1);
}

function addVolume(document: Document, p: Parameters, set: (name: string, value: ExtensionProperty) => void): void {
  const volume = document.createExtension(KHRMaterialsVolume).createVolume().setThicknessFactor(THICKNESS);
  if ((p.subsurface_weight ?? 0) > 0) {
    // The mean free paths are those of the absorption: the brightest channel keeps e^−1 after the longest of them.
    const scale = p.subsurface_radius_scale ?? [1, 0.5, 0.25];
    volume
      .setAttenuationDistance(p.subsurface_radius ?? 1)
      .setAttenuationColor(scale.map((s) => Math.exp(-1 / s)) as Colour);
  } else if ((p.transmission_depth ?? 0) > 0)
    volume.setAttenuationDistance(p.transmission_depth!).setAttenuationColor(color(p.transmission_color));
  set('KHR_materials_volume', volume);
}

/** Adds a material to a document, with the extensions that its parameters need. */
export function addMaterial(document: Document, material: Material): GltfMaterial {
  const p = material.parameters;
  const tint = (p.transmission_weight ?? 0) > 0 && !(p.transmission_depth ?? 0) ? p.transmission_color : undefined;
  const [r, g, b] = tint ?? p.base_color ?? [0.8, 0.8, 0.8];
  const result = document
    .createMaterial(material.name)
    .setBaseColorFactor([r, g, b, 1])
    .setMetallicFactor(p.base_metalness ?? 0)
    .setRoughnessFactor(p.specular_roughness ?? 0.3);
  const set = (name: string, value: ExtensionProperty) => void result.setExtension(name, value);
  if (p.specular_weight !== undefined && p.specular_weight !== 1)
    set(
      'KHR_materials_specular',
      document.createExtension(KHRMaterialsSpecular).createSpecular().setSpecularFactor(p.specular_weight),
    );
  if (p.specular_ior !== undefined && p.specular_ior !== 1.5)
    set('KHR_materials_ior', document.createExtension(KHRMaterialsIOR).createIOR().setIOR(p.specular_ior));
  if ((p.transmission_weight ?? 0) > 0)
    set(
      'KHR_materials_transmission',
      document
        .createExtension(KHRMaterialsTransmission)
        .createTransmission()
        .setTransmissionFactor(p.transmission_weight!),
    );
  if ((p.subsurface_weight ?? 0) > 0)
    set(
      'KHR_materials_diffuse_transmission',
      document
        .createExtension(KHRMaterialsDiffuseTransmission)
        .createDiffuseTransmission()
        .setDiffuseTransmissionFactor(p.subsurface_weight!)
        .setDiffuseTransmissionColorFactor(color(p.subsurface_color ?? [0.8, 0.8, 0.8])),
    );
  const solid = (p.transmission_weight ?? 0) > 0 || (p.subsurface_weight ?? 0) > 0;
  if (solid && !p.geometry_thin_walled) addVolume(document, p, set);
  if ((p.transmission_dispersion_scale ?? 0) > 0)
    set(
      'KHR_materials_dispersion',
      document
        .createExtension(KHRMaterialsDispersion)
        .createDispersion()
        .setDispersion((20 * p.transmission_dispersion_scale!) / (p.transmission_dispersion_abbe_number ?? 20)),
    );
  if ((p.specular_roughness_anisotropy ?? 0) > 0) {
    const { roughness, strength } = anisotropic(p.specular_roughness ?? 0.3, p.specular_roughness_anisotropy!);
    result.setRoughnessFactor(roughness);
    const [x, y] = p.geometry_tangent ?? [1, 0];
    set(
      'KHR_materials_anisotropy',
      document
        .createExtension(KHRMaterialsAnisotropy)
        .createAnisotropy()
        .setAnisotropyStrength(strength)
        .setAnisotropyRotation(Math.atan2(y, x)),
    );
  }
  if ((p.coat_weight ?? 0) > 0)
    set(
      'KHR_materials_clearcoat',
      document
        .createExtension(KHRMaterialsClearcoat)
        .createClearcoat()
        .setClearcoatFactor(p.coat_weight!)
        .setClearcoatRoughnessFactor(p.coat_roughness ?? 0),
    );
  if ((p.fuzz_weight ?? 0) > 0)
    set(
      'KHR_materials_sheen',
      document
        .createExtension(KHRMaterialsSheen)
        .createSheen()
        .setSheenColorFactor(color(p.fuzz_color).map((c) => c * p.fuzz_weight!) as Colour)
        .setSheenRoughnessFactor(sheenRoughness(p.fuzz_roughness ?? 0.5)),
    );
  if ((p.thin_film_weight ?? 0) > 0)
    set(
      'KHR_materials_iridescence',
      document
        .createExtension(KHRMaterialsIridescence)
        .createIridescence()
        .setIridescenceFactor(p.thin_film_weight!)
        .setIridescenceIOR(p.thin_film_ior ?? 1.4)
        .setIridescenceThicknessMaximum(1000 * (p.thin_film_thickness ?? 0.5)),
    );
  const luminance = p.emission_luminance ?? 0;
  if (luminance > 0) {
    result.setEmissiveFactor(color(p.emission_color));
    if (luminance !== 1)
      set(
        'KHR_materials_emissive_strength',
        document.createExtension(KHRMaterialsEmissiveStrength).createEmissiveStrength().setEmissiveStrength(luminance),
      );
  }
  return result;
}

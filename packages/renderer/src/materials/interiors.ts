import type { Material } from '@glanz/scene';
import { parametersOf } from './parameters';

/** Whether light may go through the material's surface into an inside. */
export function hasInterior(material: Material): boolean {
  const p = parametersOf(material);
  if (p.geometry_thin_walled || (p.base_metalness >= 1 && !material.textures?.base_metalness)) return false;
  return p.transmission_weight > 0 || p.subsurface_weight > 0;
}

/** Whether what is inside scatters light. */
function scatters(material: Material): boolean {
  const p = parametersOf(material);
  const milky = p.transmission_weight > 0 && p.transmission_depth > 0 && p.transmission_scatter.some((c) => c > 0);
  return hasInterior(material) && (milky || p.subsurface_weight > 0);
}

/** Whether the surface is a null interface where air surrounds it: all light passes, without refraction or tint. */
export function isIndexMatched(material: Material): boolean {
  const p = parametersOf(material);
  const matched = p.specular_weight === 0 || p.specular_ior === 1;
  const clear = p.transmission_weight === 1 && (p.transmission_depth > 0 || p.transmission_color.every((c) => c === 1));
  const bare = p.base_metalness === 0 && p.coat_weight === 0 && p.fuzz_weight === 0;
  return hasInterior(material) && matched && clear && bare && !material.textures?.transmission_weight;
}

/** Whether the index of refraction varies with the wavelength, where light goes through. */
export function isDispersive(material: Material): boolean {
  const { transmission_weight, transmission_dispersion_scale } = parametersOf(material);
  return hasInterior(material) && transmission_weight > 0 && transmission_dispersion_scale > 0;
}

/** Below this roughness lobes are as narrow as they get. */
const SMOOTH = 0.01;

/** Whether the surface transmits without a change of direction: a smooth thin wall that scatters nothing. */
export function transmitsByDelta(material: Material): boolean {
  const p = parametersOf(material);
  const { textures } = material;
  // Textures only lower a roughness.
  return (
    p.geometry_thin_walled &&
    p.transmission_weight > 0 &&
    p.subsurface_weight === 0 &&
    p.specular_roughness <= SMOOTH &&
    p.specular_haze === 0 &&
    (p.base_metalness < 1 || textures?.base_metalness !== undefined)
  );
}

/** Whether light samples reach what scatters inside, through a smooth surface: see `refracted_way.wesl`. */
export function refractsLight(material: Material): boolean {
  const p = parametersOf(material);
  return scatters(material) && p.transmission_weight === 1 && p.specular_roughness <= 0.005 && p.specular_ior !== 1;
}

/** The flags of the kernels that depend on the interiors of a scene's materials. */
export function interiorFlags(
  materials: readonly Material[],
): Record<'MEDIA' | 'SCATTERING' | 'NULL_SURFACES' | 'PATH_DEPTH' | 'DISPERSION' | 'DELTA_TRANSMISSION', boolean> {
  const interiors = materials.filter(hasInterior);
  const scattering = interiors.some(scatters);
  const priorities = new Set(interiors.map((material) => material.dielectric_priority ?? 0));
  const delta = materials.some(transmitsByDelta);
  const nothing = interiors.some(isIndexMatched) || priorities.size > 1 || delta;
  return {
    MEDIA: interiors.length > 0 || delta,
    DELTA_TRANSMISSION: delta,
    SCATTERING: scattering,
    NULL_SURFACES: nothing,
    PATH_DEPTH: scattering || nothing,
    DISPERSION: interiors.some(isDispersive),
  };
}

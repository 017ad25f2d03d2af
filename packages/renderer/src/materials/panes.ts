import type { Instance, Material, Scene } from '@glanz/scene';
import { transmitsByDelta } from './interiors';
import { parametersOf } from './parameters';

/** Rougher walls blur small lights themselves. */
const MAX_ROUGHNESS = 0.2;

/**
 * The instances of panes: thin walls that let light through nearly straight, but not exactly, so that light samples do
 * not pass them.
 */
export const panesOf = ({ instances, materials }: Scene): Instance[] =>
  instances.filter(({ material: index }) => {
    const material = materials[index] as Material;
    const { geometry_thin_walled, transmission_weight, specular_roughness } = parametersOf(material);
    const clear = geometry_thin_walled && transmission_weight > 0 && specular_roughness <= MAX_ROUGHNESS;
    return clear && !transmitsByDelta(material);
  });

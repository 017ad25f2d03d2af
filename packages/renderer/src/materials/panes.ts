import type { Instance, Scene } from '@glanz/scene';
import { transmitsByDelta } from './interiors';
import { parametersOf } from './parameters';

/** Rougher walls blur small lights themselves. */
const MAX_ROUGHNESS = 0.2;

/**
 * The instances of panes: thin walls that let light through nearly straight, but not exactly, so that light samples do
 * not pass them.
 */
export function panesOf({ instances, materials }: Scene): Instance[] {
  const panes = materials.map((material) => {
    const p = parametersOf(material);
    const clear = p.geometry_thin_walled && p.transmission_weight > 0;
    return clear && p.specular_roughness <= MAX_ROUGHNESS && !transmitsByDelta(material);
  });
  return instances.filter(({ material }) => panes[material]);
}

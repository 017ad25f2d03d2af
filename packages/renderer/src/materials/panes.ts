import type { Instance, Material, Scene } from '@glanz/scene';
import { transmitsByDelta } from './interiors';
import { parametersOf } from './parameters';

/** Rougher walls blur small lights themselves. */
const MAX_ROUGHNESS = 0.2;

/** Whether a wall lets light through nearly straight, but not exactly, so that light samples do not pass it. */
function isClear(material: Material): boolean {
  const { geometry_thin_walled, transmission_weight, specular_roughness } = parametersOf(material);
  const clear = geometry_thin_walled && transmission_weight > 0 && specular_roughness <= MAX_ROUGHNESS;
  return clear && !transmitsByDelta(material);
}

/** The instances of panes: thin walls that scatter little. */
export function panesOf({ instances, materials }: Scene): Instance[] {
  const clear = materials.map(isClear);
  return clear.includes(true) ? instances.filter(({ material }) => clear[material]) : [];
}

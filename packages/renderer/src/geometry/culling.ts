import type { Material } from '@glanz/scene';
import { parametersOf } from '../materials/parameters';

/**
 * Whether a material's back faces are left out where back faces are culled: not those of materials that let light
 * through, for without their back faces glass would have no inside.
 *
 * @param opaque Whether it is fully there wherever it is.
 */
export function isOneSided(material: Material, opaque: boolean): boolean {
  const { transmission_weight, subsurface_weight } = parametersOf(material);
  return (
    material.double_sided !== true &&
    transmission_weight === 0 &&
    subsurface_weight === 0 &&
    (opaque || material.opacity_threshold !== undefined)
  );
}

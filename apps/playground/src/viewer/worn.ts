import type { Scene } from '@glanz/scene';
import type { Chosen } from '../selection';

/** The material that a part wears in a variant; null: as made. */
export function wornMaterial(
  { instances, variants = [] }: Pick<Scene, 'instances' | 'variants'>,
  instance: number,
  variant: string | null,
): number {
  const part = instances[instance];
  const index = variant === null ? -1 : variants.indexOf(variant);
  return part?.variants?.[index] ?? part?.material ?? 0;
}

/**
 * What is chosen after a change of variant: the material that the chosen part, or the first that wore the chosen
 * material, wears now.
 */
export function chosenInVariant(
  scene: Pick<Scene, 'instances' | 'variants'>,
  { material, instance }: Chosen,
  before: string | null,
  next: string | null,
): Chosen {
  const part = instance ?? scene.instances.findIndex((_, i) => wornMaterial(scene, i, before) === material);
  // A material that nothing wears is chosen for its own sake.
  return part < 0 || wornMaterial(scene, part, before) !== material
    ? { material, instance }
    : { material: wornMaterial(scene, part, next), instance };
}

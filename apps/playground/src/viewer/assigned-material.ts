import type { Scene } from '@glanz/scene';
import { chosenParts, type Chosen } from '../selection';

/** The material that a part has in a variant; null: its own. */
export function assignedMaterial(
  { instances, variants = [] }: Pick<Scene, 'instances' | 'variants'>,
  instance: number,
  variant: string | null,
): number {
  const part = instances[instance];
  const index = variant === null ? -1 : variants.indexOf(variant);
  return part?.variants?.[index] ?? part?.material ?? 0;
}

/** Materials of all chosen parts, each once, that of {@link Chosen.material} first: edits apply to them. */
export const chosenMaterials = (
  scene: Pick<Scene, 'instances' | 'variants'>,
  chosen: Chosen,
  variant: string | null,
): readonly number[] => [
  ...new Set([
    chosen.material,
    ...chosenParts(chosen)
      .slice(1)
      .map((part) => assignedMaterial(scene, part, variant)),
  ]),
];

/**
 * The selection after a change of variant: the material that the selected part, or the first part with the selected
 * material, has now.
 */
export function chosenInVariant(
  scene: Pick<Scene, 'instances' | 'variants'>,
  { material, instance, others }: Chosen,
  before: string | null,
  next: string | null,
): Chosen {
  const part = instance ?? scene.instances.findIndex((_, i) => assignedMaterial(scene, i, before) === material);
  // A material that no part has stays selected.
  return part < 0 || assignedMaterial(scene, part, before) !== material
    ? { material, instance, others }
    : { material: assignedMaterial(scene, part, next), instance, others };
}

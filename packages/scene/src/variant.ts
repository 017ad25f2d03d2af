import { SceneError } from './error';
import type { Scene } from './scene';

/**
 * The scene in another material variant: the same meshes, materials and images, with other materials assigned to the
 * instances.
 *
 * @param variant Name or index in `scene.variants`; undefined: the scene as it is.
 * @returns A scene that shares everything but the instances. Start from the scene as loaded: instances that a variant
 *   does not name keep the material that they have.
 * @throws {SceneError} `scene/reference` for a variant that the scene does not have.
 * @example
 * const street = withVariant(scene, 'street');
 */
export function withVariant(scene: Scene, variant: number | string | undefined): Scene {
  if (variant === undefined) return scene;
  const names = scene.variants ?? [];
  const index = typeof variant === 'number' ? variant : names.indexOf(variant);
  if (names[index] === undefined)
    throw new SceneError(
      'scene/reference',
      `The scene has no variant ${typeof variant === 'number' ? variant : `"${variant}"`}; it has ${names.length === 0 ? 'none' : names.map((name) => `"${name}"`).join(', ')}.`,
    );
  return {
    ...scene,
    instances: scene.instances.map((instance) => {
      const material = instance.variants?.[index];
      return material === undefined ? instance : { ...instance, material };
    }),
  };
}

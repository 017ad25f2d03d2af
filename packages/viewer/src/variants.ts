import type { Scene } from '@glanz/scene';

/**
 * A scene out of a variant: instances that use the variant's material get their own back, so that the
 * variant can be applied and removed again.
 *
 * @param scene As it is in the tracer.
 * @param loaded As it came.
 */
export function plainScene(scene: Scene, loaded: Scene, variant: string | undefined): Scene {
  const index = variant === undefined ? -1 : (loaded.variants ?? []).indexOf(variant);
  if (index < 0) return scene;
  return {
    ...scene,
    instances: scene.instances.map((instance, i) => {
      const own = loaded.instances[i];
      return own && instance.material === (own.variants?.[index] ?? own.material)
        ? { ...instance, material: own.material }
        : instance;
    }),
  };
}

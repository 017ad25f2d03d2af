import type { Scene } from '@glanz/scene';

/** Ground beneath a model, which catches its shadows. */
export interface GroundOptions {
  /** Strength of the shadows, 0 (none) to 1 (as the light gives them). Default 1. */
  readonly shadow?: number;
  /** Strength of the model's reflection in the ground, 0 (none, matt) to 1. Default 0. */
  readonly reflection?: number;
}

/** Name of the ground's mesh, material and instance, which is the last one of its scene. */
export const GROUND = 'glanz-ground';

/** A scene as it is framed: without the ground, which is no part of the model. */
export function withoutGround(scene: Scene): Scene {
  const { instances } = scene;
  return instances[instances.length - 1]?.name === GROUND ? { ...scene, instances: instances.slice(0, -1) } : scene;
}

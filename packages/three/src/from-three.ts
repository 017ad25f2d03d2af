import type { Scene } from '@glanz/scene';
import { convert, type FromThreeOptions } from './convert';
import type { ThreeCamera, ThreeObject } from './types';

export type { FromThreeOptions };

/**
 * Converts a scene of three.js, as it is posed now: meshes (also instanced, batched, skinned, morphed), standard,
 * physical and basic materials with their textures, lights, the environment, and a camera. What is not supported is
 * listed in `scene.warnings`. Nothing of three.js is imported: any version since 0.160 will do. The result shares no
 * memory with it.
 *
 * @param root A `THREE.Scene`, or any object; its world matrices are brought up to date.
 * @param camera Becomes the scene's first camera.
 * @throws {ThreeError} `three/not-three`, `three/no-triangles`.
 * @throws the signal's reason, when aborted.
 * @example
 * await viewer.load(await fromThree(scene, camera));
 */
export async function fromThree(
  root: ThreeObject,
  camera?: ThreeCamera,
  options: FromThreeOptions = {},
): Promise<Scene> {
  return (await convert(root, camera, options)).scene;
}

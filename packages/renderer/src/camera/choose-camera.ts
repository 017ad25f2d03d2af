import { frameCameraSteps, type Camera, type Scene } from '@glanz/scene';
import { notFound } from '../errors';

/**
 * A camera as the options name it: an object, one of the scene's by index or name, or by default the scene's first or
 * one that frames it; in steps of a millisecond or so.
 * @throws {RenderError} `renderer/camera`
 */
export function* cameraSteps(
  scene: Scene,
  camera: Camera | number | string | undefined,
  aspect: number,
): Generator<void, Camera> {
  if (typeof camera === 'object') return camera;
  if (camera === undefined) return scene.cameras[0] ?? (yield* frameCameraSteps(scene, { aspect }));
  const found = typeof camera === 'number' ? scene.cameras[camera] : scene.cameras.find(({ name }) => name === camera);
  if (!found) throw notFound('renderer/camera', camera, scene.cameras);
  return found;
}

/**
 * As {@link cameraSteps}, of a camera that is given: nothing is scanned.
 * @throws {RenderError} `renderer/camera`
 */
export function chooseCamera(scene: Scene, camera: Camera | number | string, aspect: number): Camera {
  return cameraSteps(scene, camera, aspect).next().value as Camera;
}

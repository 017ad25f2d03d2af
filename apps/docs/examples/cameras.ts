import type { PathTracer } from '@glanz/renderer';
import {
  frameCamera,
  type OrthographicCamera,
  type PanoramaCamera,
  type PerspectiveCamera,
} from '@glanz/scene';
import { cameraExposure, toneMapPixels } from '@glanz/tonemap';

// #region frame
export function fromTheLeft(tracer: PathTracer) {
  const camera = frameCamera(tracer.scene, {
    aspect: tracer.width / tracer.height,
    direction: [-1, 0.4, 0.8], // from the scene towards the camera
    yfov: (24 * Math.PI) / 180, // longer lens, less perspective
    margin: 0.1,
  });
  void tracer.setCamera(camera);
}
// #endregion frame

// #region lens
export function withLens(
  camera: PerspectiveCamera,
  focus: number,
  fStop: number,
): PerspectiveCamera {
  const sensorHeight = 0.024; // 24 mm, a full-frame camera
  const focalLength = sensorHeight / (2 * Math.tan(camera.yfov / 2));
  return {
    ...camera,
    lens_radius: focalLength / (2 * fStop),
    focus_distance: focus,
  };
}
// #endregion lens

// #region focus
export function focusOn(tracer: PathTracer, x: number, y: number) {
  const hit = tracer.pick(x, y);
  if (!hit || tracer.camera.type !== 'perspective') return;
  void tracer.setCamera(withLens(tracer.camera, hit.depth, 4));
}
// #endregion focus

// #region orthographic
export const plan: OrthographicCamera = {
  type: 'orthographic',
  name: 'plan',
  // Five metres up, looking down.
  transform: [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 5, 0, 1],
  xmag: 1.6,
  ymag: 1.2,
};
// #endregion orthographic

// #region panorama
export const around: PanoramaCamera = {
  type: 'panorama',
  name: 'around',
  // At eye height, its −Z along +X.
  transform: [0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 1.6, 0, 1],
};
// #endregion panorama

// #region exposure
export async function photograph(tracer: PathTracer) {
  const exposure = cameraExposure({ fStop: 8, shutter: 1 / 125, iso: 200 });
  return toneMapPixels(
    await tracer.read('beauty'),
    tracer.width,
    tracer.height,
    { toneMap: 'agx', exposure },
  );
}
// #endregion exposure

import type { PathTracer } from '@glanz/renderer';
import { frameCamera, type OrthographicCamera, type PerspectiveCamera } from '@glanz/scene';

// #region frame
export function fromTheLeft(tracer: PathTracer) {
  const camera = frameCamera(tracer.scene, {
    aspect: tracer.width / tracer.height,
    direction: [-1, 0.4, 0.8], // from the scene towards the camera
    yfov: (24 * Math.PI) / 180, // longer lens, less perspective
    margin: 0.1,
  });
  tracer.setCamera(camera);
}
// #endregion frame

// #region lens
export function withLens(camera: PerspectiveCamera, focus: number, fStop: number): PerspectiveCamera {
  const sensorHeight = 0.024; // 24 mm, a full-frame camera
  const focalLength = sensorHeight / (2 * Math.tan(camera.yfov / 2));
  return { ...camera, lens_radius: focalLength / (2 * fStop), focus_distance: focus };
}
// #endregion lens

// #region focus
export function focusOn(tracer: PathTracer, x: number, y: number) {
  const hit = tracer.pick(x, y);
  if (!hit || tracer.camera.type !== 'perspective') return;
  const m = tracer.camera.transform;
  const [dx, dy, dz] = hit.position.map((p, i) => p - m[12 + i]!) as [number, number, number];
  const alongAxis = -(dx * m[8]! + dy * m[9]! + dz * m[10]!); // the camera looks along its −Z
  tracer.setCamera(withLens(tracer.camera, alongAxis, 4));
}
// #endregion focus

// #region orthographic
export const plan: OrthographicCamera = {
  type: 'orthographic',
  name: 'plan',
  transform: [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 5, 0, 1], // five metres up, looking down
  xmag: 1.6,
  ymag: 1.2,
};
// #endregion orthographic

import type { Camera } from '@glanz/scene';
import type { Lens } from '../state/state';

/** Height of the sensor that focal lengths are given for: full frame, 36 × 24 mm. */
const SENSOR_HEIGHT = 0.024;

const DEGREE = Math.PI / 180;

/** Focal length in millimetres of a full-frame camera with this vertical field of view, degrees. */
export const focalLength = (fov: number): number => (1000 * SENSOR_HEIGHT) / (2 * Math.tan((fov * DEGREE) / 2));

/** Vertical field of view in degrees of a full-frame camera with this focal length, millimetres. */
export const fieldOfView = (millimetres: number): number =>
  (2 * Math.atan((1000 * SENSOR_HEIGHT) / (2 * millimetres))) / DEGREE;

/** Metres along the axis at which an orbiting camera is sharp by itself. */
const subjectDistance = (camera: Camera): number => (camera.type === 'perspective' ? (camera.focus_distance ?? 1) : 1);

/**
 * A camera with the lens that the user chose.
 *
 * @param camera Perspective cameras are turned into others; others stay as they are.
 * @param aspect Width over height of the film.
 */
export function withLens(camera: Camera, lens: Lens, aspect: number): Camera {
  if (camera.type !== 'perspective') return camera;
  const yfov = lens.fov === null ? camera.yfov : lens.fov * DEGREE;
  const distance = subjectDistance(camera);
  if (lens.projection === 'orthographic') {
    const ymag = distance * Math.tan(yfov / 2);
    return { type: 'orthographic', name: camera.name, transform: camera.transform, ymag, xmag: ymag * aspect };
  }
  const { lens_radius: _radius, lens_blades: _blades, ...rest } = camera;
  // The diameter of the pupil is the focal length over the f-number.
  const radius = lens.stop > 0 ? focalLength(yfov / DEGREE) / 1000 / lens.stop / 2 : 0;
  return {
    ...rest,
    yfov,
    focus_distance: lens.focus ?? distance,
    ...(radius > 0 ? { lens_radius: radius, ...(lens.blades >= 3 ? { lens_blades: lens.blades } : {}) } : {}),
  };
}

/** Views along the axes and one from the front right above: yaw and pitch, radians. */
export const STANDARD_VIEWS = {
  front: { title: 'Front', yaw: 0, pitch: 0 },
  right: { title: 'Right', yaw: Math.PI / 2, pitch: 0 },
  back: { title: 'Back', yaw: Math.PI, pitch: 0 },
  left: { title: 'Left', yaw: -Math.PI / 2, pitch: 0 },
  top: { title: 'Top', yaw: 0, pitch: Math.PI / 2 },
  bottom: { title: 'Bottom', yaw: 0, pitch: -Math.PI / 2 },
  corner: { title: 'Corner', yaw: 0.62, pitch: 0.42 },
} as const;
export type StandardView = keyof typeof STANDARD_VIEWS;

/** The direction from the target to the camera. */
export function directionOf({
  yaw,
  pitch,
}: {
  readonly yaw: number;
  readonly pitch: number;
}): readonly [number, number, number] {
  // Straight up and down there is no "up" in the image.
  const steep = Math.max(-1.55, Math.min(1.55, pitch));
  return [Math.sin(yaw) * Math.cos(steep), Math.sin(steep), Math.cos(yaw) * Math.cos(steep)];
}

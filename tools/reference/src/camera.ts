import type { PerspectiveCamera } from '@glanz/scene';

type Vector = readonly [number, number, number];

/** Options for {@link lookAt}. */
export interface LookAt {
  readonly position: Vector;
  readonly target: Vector;
  readonly up: Vector;
  /** Vertical field of view, degrees. */
  readonly yfov_deg: number;
  /** Metres. */
  readonly lens_radius: number;
  readonly focus_distance: number;
}

/** A camera at a place that looks at another. */
export function lookAt(camera: LookAt): PerspectiveCamera {
  const subtract = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const cross = (a: Vector, b: Vector): Vector => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
  ];
  const unit = (a: Vector): Vector => {
    const length = Math.hypot(...a);
    return [a[0] / length, a[1] / length, a[2] / length];
  };
  const z = unit(subtract(camera.position, camera.target));
  const x = unit(cross(camera.up, z));
  const y = cross(z, x);
  return {
    type: 'perspective',
    name: 'reference',
    transform: [...x, 0, ...y, 0, ...z, 0, ...camera.position, 1],
    yfov: (camera.yfov_deg * Math.PI) / 180,
    aspect: 1,
    lens_radius: camera.lens_radius,
    focus_distance: camera.focus_distance,
  };
}

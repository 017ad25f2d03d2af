import type { Camera } from '@glanz/scene';
import { dot, subtract } from 'gl-matrix/esm/vec3.js';
import { column, unit, type Vector } from './orbit-state';

/** Where a point of the world falls on the image. */
export interface Projection {
  /** Share of the image's width from the left; 0..1 where it is in the image. */
  readonly x: number;
  /** Share of its height from the top. */
  readonly y: number;
  /** Metres from the camera. */
  readonly distance: number;
  /** Whether it lies in front of the camera and within the image. */
  readonly inside: boolean;
}

/**
 * Projects a point as the renderer does. The camera's field of view is that of the image's height.
 *
 * @param aspect Width over height of the image.
 */
export function project(camera: Camera, aspect: number, point: Vector): Projection {
  const m = camera.transform;
  const to = subtract([0, 0, 0], point, column(m, 12));
  const along = (k: number) => dot(to, unit(column(m, k)));
  const [right, up, ahead] = [along(0), along(4), -along(8)];
  const distance = Math.hypot(...to);
  if (camera.type === 'panorama') {
    const x = Math.atan2(right, ahead) / (2 * Math.PI) + 0.5;
    return { x, y: Math.acos(Math.max(-1, Math.min(1, up / (distance || 1)))) / Math.PI, distance, inside: true };
  }
  const half =
    camera.type === 'orthographic'
      ? [camera.xmag, camera.ymag]
      : [Math.tan(camera.yfov / 2) * aspect * ahead, Math.tan(camera.yfov / 2) * ahead];
  const x = 0.5 + (0.5 * right) / (half[0] || 1e-12);
  const y = 0.5 - (0.5 * up) / (half[1] || 1e-12);
  return { x, y, distance, inside: ahead > 0 && x >= 0 && x <= 1 && y >= 0 && y <= 1 };
}

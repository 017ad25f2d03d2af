import type { Camera } from '@glanz/scene';
import { dot, normalize, subtract } from 'gl-matrix/esm/vec3.js';
import type { Rgb } from '../state/state';

/** A point on the screen. */
export interface Projected {
  /** CSS pixels from the left and the top of the image. */
  readonly x: number;
  readonly y: number;
  /** Metres that a pixel shows there, across the view. */
  readonly metres: number;
}

/** How a camera shows points of the world. */
export interface Projection {
  readonly right: Rgb;
  readonly up: Rgb;
  /** Undefined behind the camera, and for one that looks all around. */
  readonly at: (point: Rgb) => Projected | undefined;
  /** The direction from a point to the camera. */
  readonly towards: (point: Rgb) => Rgb;
}

const zero = () => [0, 0, 0] as [number, number, number];

/** @param width Of the image, CSS pixels. @param height Of the image: the camera's vertical extent is all of it. */
export function projection(camera: Camera, width: number, height: number): Projection {
  const m = camera.transform;
  const column = (at: number): Rgb => [m[at] as number, m[at + 1] as number, m[at + 2] as number];
  const [right, up, back] = [0, 4, 8].map((at) => normalize(zero(), column(at)) as unknown as Rgb) as [Rgb, Rgb, Rgb];
  const eye = column(12);
  return {
    right,
    up,
    at: (point) => {
      const arm = subtract(zero(), point, eye);
      const depth = -dot(arm, back);
      if (camera.type === 'panorama' || (camera.type === 'perspective' && depth <= 1e-9)) return undefined;
      // Half the height of what is seen at that depth.
      const half = camera.type === 'perspective' ? depth * Math.tan(camera.yfov / 2) : camera.ymag;
      const metres = (2 * half) / height;
      return { x: width / 2 + dot(arm, right) / metres, y: height / 2 - dot(arm, up) / metres, metres };
    },
    towards: (point) =>
      camera.type === 'perspective' ? (normalize(zero(), subtract(zero(), eye, point)) as unknown as Rgb) : back,
  };
}

import { sceneBounds } from './bounds';
import type { PerspectiveCamera } from './camera';
import { SceneError } from './error';
import type { Scene } from './scene';

/** What {@link frameCamera} may be told. */
export interface FrameCameraOptions {
  /** Width over height of the picture. */
  readonly aspect: number;
  /** Vertical field of view, radians, in (0, π). Default 35°. */
  readonly yfov?: number;
  /** From the scene towards the camera, any length; not straight up or down. Default front-right-above: (0.6, 0.45, 1). */
  readonly direction?: readonly [number, number, number];
  /** Part of the picture's half width and height left free around the scene, in [0, 1). Default 0.06. */
  readonly margin?: number;
}

type Vector = readonly [number, number, number];

const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vector, b: Vector): Vector => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

function normalized(v: Vector, what: string): Vector {
  const length = Math.hypot(...v);
  if (!(length > 1e-12) || !Number.isFinite(length)) throw new SceneError('scene/value', `${what} is [${v.join(', ')}], which gives no direction.`);
  return [v[0] / length, v[1] / length, v[2] / length];
}

/**
 * A camera that sees the whole scene: as near as the box around it allows, looking at the box's centre.
 *
 * @throws {SceneError} `scene/empty` if the scene has no visible triangles, `scene/value` for options out of range.
 */
export function frameCamera(scene: Scene, { aspect, yfov = (35 * Math.PI) / 180, direction = [0.6, 0.45, 1], margin = 0.06 }: FrameCameraOptions): PerspectiveCamera {
  if (!(aspect > 0 && aspect < Infinity)) throw new SceneError('scene/value', `aspect is ${aspect}; it must be a positive number.`);
  if (!(yfov > 0 && yfov < Math.PI)) throw new SceneError('scene/value', `yfov is ${yfov}; it must lie between 0 and π.`);
  if (!(margin >= 0 && margin < 1)) throw new SceneError('scene/value', `margin is ${margin}; it must be at least 0 and less than 1.`);
  const { min, max } = sceneBounds(scene);
  if (!(min[0] <= max[0])) throw new SceneError('scene/empty', 'The scene has no visible triangles: there is nothing to frame.');
  const center: Vector = [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2];
  const back = normalized(direction, 'direction');
  const right = normalized(cross([0, 1, 0], back), 'direction, seen from above,');
  const up = cross(back, right);
  const tangentY = Math.tan(yfov / 2) * (1 - margin);
  const tangentX = tangentY * aspect;
  let distance = 0;
  for (let corner = 0; corner < 8; corner++) {
    const p: Vector = [(corner & 1 ? max : min)[0] - center[0], (corner & 2 ? max : min)[1] - center[1], (corner & 4 ? max : min)[2] - center[2]];
    distance = Math.max(distance, dot(p, back) + Math.max(Math.abs(dot(p, right)) / tangentX, Math.abs(dot(p, up)) / tangentY));
  }
  // A scene that is one point is looked at from a metre away.
  if (distance === 0) distance = 1;
  const eye = [0, 1, 2].map((k) => (center[k] as number) + (back[k] as number) * distance);
  return { type: 'perspective', name: 'framed', transform: [...right, 0, ...up, 0, ...back, 0, ...eye, 1], yfov, aspect, focus_distance: distance };
}

import { boundsBy } from './bounds';
import type { PerspectiveCamera } from './camera';
import { SceneError } from './error';
import { extentSteps, type ExtentCache } from './extents';
import type { Scene } from './scene';
import { finish } from './slices';

/** Options for {@link frameCamera}. */
export interface FrameCameraOptions {
  /** Width over height of the image. */
  readonly aspect: number;
  /** Vertical field of view, radians, in (0, π). Default 35°. */
  readonly yfov?: number;
  /**
   * From the scene towards the camera, any length; not straight up or down. Default front-right-above: (0.6, 0.45, 1).
   */
  readonly direction?: readonly [number, number, number];
  /** Fraction of the image's half width and height left free around the scene, in [0, 1). Default 0.06. */
  readonly margin?: number;
}

type Vector = readonly [number, number, number];
const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

function normalized(v: Vector, what: string): Vector {
  const length = Math.hypot(...v);
  if (!(length > 1e-12) || !Number.isFinite(length))
    throw new SceneError(
      'scene/value',
      `${what} is [${v.join(', ')}], which has no usable length; give a direction that is neither zero nor vertical.`,
    );
  return [v[0] / length, v[1] / length, v[2] / length];
}

/**
 * A camera that sees the whole scene: of all that look in the given direction, the nearest one with every visible
 * vertex inside the frame less its margin. The subject fills the image's width or its height, and is about centred in
 * the other dimension. The plane in focus is half-way through the scene.
 *
 * @throws {SceneError} `scene/empty` if the scene has no visible triangles, `scene/value` for options out of range.
 */
export function frameCamera(scene: Scene, options: FrameCameraOptions): PerspectiveCamera {
  return finish(frameCameraSteps(scene, options));
}

/**
 * The same as {@link frameCamera} in steps of a millisecond or so, for `inSlices`. The scene must stay as it is until
 * the last step.
 *
 * @throws {SceneError} as {@link frameCamera}, at the first step or a later one.
 */
export function* frameCameraSteps(
  scene: Scene,
  { aspect, yfov = (35 * Math.PI) / 180, direction = [0.6, 0.45, 1], margin = 0.06 }: FrameCameraOptions,
): Generator<void, PerspectiveCamera> {
  if (!(aspect > 0 && aspect < Infinity))
    throw new SceneError('scene/value', `aspect is ${aspect}; it must be a positive number.`);
  if (!(yfov > 0 && yfov < Math.PI))
    throw new SceneError('scene/value', `yfov is ${yfov}; it must lie between 0 and π.`);
  if (!(margin >= 0 && margin < 1))
    throw new SceneError('scene/value', `margin is ${margin}; it must be at least 0 and less than 1.`);
  const cache: ExtentCache = { vertices: new Map() };
  const { min, max } = yield* boundsBy(scene, cache);
  if (!(min[0] <= max[0])) throw new SceneError('scene/empty', 'The scene has no visible triangles: nothing to frame.');
  const center: Vector = [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2];
  const back = normalized(direction, 'direction');
  const right = normalized(cross([0, 1, 0], back), 'direction, seen from above,');
  const up = cross(back, right);
  const ty = Math.tan(yfov / 2) * (1 - margin);
  const tx = ty * aspect;
  // Extents along the normals of the frustum's right, left, top and bottom planes, then the nearest and farthest
  // depth. Relative to the box's centre, so that a small part far from the origin keeps its precision.
  const tilted = (side: Vector, by: number, t: number): Vector => [
    by * side[0] + t * back[0],
    by * side[1] + t * back[1],
    by * side[2] + t * back[2],
  ];
  const directions = [
    tilted(right, 1, tx),
    tilted(right, -1, tx),
    tilted(up, 1, ty),
    tilted(up, -1, ty),
    back,
    tilted(back, -1, 0),
  ];
  const reached = yield* extentSteps(scene, directions, center, cache);
  const [toRight, toLeft, toTop, toBottom, near, away] = reached as unknown as [
    number,
    number,
    number,
    number,
    number,
    number,
  ];
  const far = -away;
  // A camera at (x, y, d) in the frame sees a vertex (r, u, b) if |r − x| ≤ tx (d − b), and so for u: the edges'
  // planes.
  const x = (toRight - toLeft) / 2;
  const y = (toTop - toBottom) / 2;
  let d = Math.max((toRight + toLeft) / (2 * tx), (toTop + toBottom) / (2 * ty));
  // A line seen along its length, a point, and a cone whose tip would touch the camera have no size to fit: they are
  // seen from a distance equal to their depth, or from a metre away.
  if (!(d - near > 1e-6 * (near - far))) d = near + (near - far || 1);
  const eye = [0, 1, 2].map(
    (k) => (center[k] as number) + (right[k] as number) * x + (up[k] as number) * y + (back[k] as number) * d,
  );
  return {
    type: 'perspective',
    name: 'framed',
    transform: [...right, 0, ...up, 0, ...back, 0, ...eye, 1],
    yfov,
    aspect,
    focus_distance: d - (near + far) / 2,
  };
}

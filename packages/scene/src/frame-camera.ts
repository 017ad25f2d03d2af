import { boundsBy, usedOf } from './bounds';
import type { PerspectiveCamera } from './camera';
import { SceneError } from './error';
import type { Mesh } from './mesh';
import type { Scene } from './scene';
import { finish, STEP } from './slices';

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
type Row = readonly [number, number, number, number];

const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vector, b: Vector): Vector => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

function normalized(v: Vector, what: string): Vector {
  const length = Math.hypot(...v);
  if (!(length > 1e-12) || !Number.isFinite(length)) throw new SceneError('scene/value', `${what} is [${v.join(', ')}], which gives no direction.`);
  return [v[0] / length, v[1] / length, v[2] / length];
}

/** Largest and smallest extents of the visible triangles' vertices in the camera's frame, as {@link frameCamera} needs them. */
interface Extents {
  /** max(right + tx·back) and max(−right + tx·back): how far the planes at the right and left edge must lie outside. */
  right: number;
  left: number;
  top: number;
  bottom: number;
  near: number;
  far: number;
}

/** In doubles, and relative to the box's centre, so that a small part far from the origin keeps its digits. */
function growByInstance(extents: Extents, { positions }: Mesh, used: Uint8Array, from: number, to: number, m: ArrayLike<number>, center: Vector, axes: readonly [Vector, Vector, Vector], tx: number, ty: number): void {
  const column = (k: number): Vector => [m[4 * k] as number, m[4 * k + 1] as number, m[4 * k + 2] as number];
  const origin = column(3);
  const moved: Vector = [origin[0] - center[0], origin[1] - center[1], origin[2] - center[2]];
  const [[rx, ry, rz, rw], [ux, uy, uz, uw], [bx, by, bz, bw]] = axes.map((axis): Row => [dot(axis, column(0)), dot(axis, column(1)), dot(axis, column(2)), dot(axis, moved)]) as [Row, Row, Row];
  let { right, left, top, bottom, near, far } = extents;
  for (let i = from, v = 3 * from; i < to; i++, v += 3) {
    if (used[i] === 0) continue;
    const px = positions[v] as number, py = positions[v + 1] as number, pz = positions[v + 2] as number;
    const r = rx * px + ry * py + rz * pz + rw;
    const u = ux * px + uy * py + uz * pz + uw;
    const b = bx * px + by * py + bz * pz + bw;
    right = Math.max(right, r + tx * b);
    left = Math.max(left, tx * b - r);
    top = Math.max(top, u + ty * b);
    bottom = Math.max(bottom, ty * b - u);
    near = Math.max(near, b);
    far = Math.min(far, b);
  }
  Object.assign(extents, { right, left, top, bottom, near, far });
}

/**
 * A camera that sees the whole scene: of all that look the given way, the nearest one with every visible vertex inside
 * the frame less its margin. The subject fills the picture's width or its height, and is near the middle the other way. The
 * plane in focus is half-way through the scene.
 *
 * @throws {SceneError} `scene/empty` if the scene has no visible triangles, `scene/value` for options out of range.
 */
export function frameCamera(scene: Scene, options: FrameCameraOptions): PerspectiveCamera {
  return finish(frameCameraSteps(scene, options));
}

/**
 * The same as {@link frameCamera} in steps of a millisecond or so, for `inSlices`. The scene must stay as it is until the
 * last step.
 *
 * @throws {SceneError} as {@link frameCamera}, at the first step or a later one.
 */
export function* frameCameraSteps(scene: Scene, { aspect, yfov = (35 * Math.PI) / 180, direction = [0.6, 0.45, 1], margin = 0.06 }: FrameCameraOptions): Generator<void, PerspectiveCamera> {
  if (!(aspect > 0 && aspect < Infinity)) throw new SceneError('scene/value', `aspect is ${aspect}; it must be a positive number.`);
  if (!(yfov > 0 && yfov < Math.PI)) throw new SceneError('scene/value', `yfov is ${yfov}; it must lie between 0 and π.`);
  if (!(margin >= 0 && margin < 1)) throw new SceneError('scene/value', `margin is ${margin}; it must be at least 0 and less than 1.`);
  const found = new Map<Mesh, Uint8Array>();
  const { min, max } = yield* boundsBy(scene, found);
  if (!(min[0] <= max[0])) throw new SceneError('scene/empty', 'The scene has no visible triangles: there is nothing to frame.');
  const center: Vector = [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2];
  const back = normalized(direction, 'direction');
  const right = normalized(cross([0, 1, 0], back), 'direction, seen from above,');
  const up = cross(back, right);
  const ty = Math.tan(yfov / 2) * (1 - margin);
  const tx = ty * aspect;
  const e: Extents = { right: -Infinity, left: -Infinity, top: -Infinity, bottom: -Infinity, near: -Infinity, far: Infinity };
  for (const { mesh: index, transform, visible } of scene.instances) {
    const mesh = scene.meshes[index];
    if (visible === false || !mesh) continue;
    const used = yield* usedOf(mesh, found);
    for (let from = 0; from < used.length; from += STEP) {
      growByInstance(e, mesh, used, from, Math.min(used.length, from + STEP), transform, center, [right, up, back], tx, ty);
      yield;
    }
  }
  // A camera at (x, y, d) in the frame sees a vertex (r, u, b) if |r − x| ≤ tx (d − b), and so for u: the edges' planes.
  const x = (e.right - e.left) / 2;
  const y = (e.top - e.bottom) / 2;
  let d = Math.max((e.right + e.left) / (2 * tx), (e.top + e.bottom) / (2 * ty));
  // Seen edge-on, a line or a point has no size to go by: it is looked at from as far as it is deep, or from a metre away.
  if (!(d > e.near)) d = e.near + (e.near - e.far || 1);
  const eye = [0, 1, 2].map((k) => (center[k] as number) + (right[k] as number) * x + (up[k] as number) * y + (back[k] as number) * d);
  return { type: 'perspective', name: 'framed', transform: [...right, 0, ...up, 0, ...back, 0, ...eye, 1], yfov, aspect, focus_distance: d - (e.near + e.far) / 2 };
}

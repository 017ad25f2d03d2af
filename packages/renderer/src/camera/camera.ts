import { checkScene, createScene, type Camera } from '@glanz/scene';
import { RenderError } from '../errors';
import { cross } from '../vector';

/** The camera's part of the frame uniforms. */
export interface CameraUniforms {
  readonly camera_origin: readonly number[];
  readonly camera_right: readonly number[];
  readonly camera_up: readonly number[];
  readonly camera_forward: readonly number[];
  readonly lens_radius: number;
  readonly focus_distance: number;
  readonly lens_blades: number;
  readonly lens_rotation: number;
  /**
   * Half width and half height of the image at distance 1 (perspective), in metres (orthographic), or in radians
   * (panorama).
   */
  readonly half_extent: readonly [number, number];
  /** Width of a pixel's footprint at the camera, metres, and its growth per metre. */
  readonly cone_width: number;
  readonly cone_spread: number;
}

/** Refuses what cannot be rendered, and what would be rendered as something else. */
function checkCamera(camera: Camera): void {
  if (camera.transform?.length !== 16)
    throw new RenderError('renderer/camera', `Camera "${camera.name}" needs a transform of 16 numbers, column-major.`);
  try {
    checkScene({ ...createScene(), cameras: [camera] });
  } catch (cause) {
    throw new RenderError('renderer/camera', (cause as Error).message, { cause });
  }
}

function axis(transform: ArrayLike<number>, column: number): number[] {
  const v = [0, 1, 2].map((i) => transform[column * 4 + i] as number);
  const length = Math.hypot(...v);
  if (!(length > 0) || !Number.isFinite(length))
    throw new RenderError(
      'renderer/camera',
      `The camera's transform has a zero or non-finite axis (column ${column}).`,
    );
  return v.map((x) => x / length);
}

/**
 * Packs a camera for a film of `width` × `height` pixels. The film keeps the vertical field of view.
 * @throws {RenderError} `renderer/camera` for numbers that are not finite or absurd, a degenerate transform, or a field
 * of view out of range.
 */
export function cameraUniforms(camera: Camera, width: number, height: number): CameraUniforms {
  checkCamera(camera);
  const forward = axis(camera.transform, 2).map((x) => -x);
  const upHint = axis(camera.transform, 1);
  const right = cross(forward, upHint);
  const length = Math.hypot(...right);
  if (!(length > 1e-6)) throw new RenderError('renderer/camera', "The camera's up and view axes are parallel.");
  const unitRight = right.map((x) => x / length);
  const up = cross(unitRight, forward);
  const camera_origin = [0, 1, 2].map((i) => camera.transform[12 + i] as number);
  const base = {
    camera_origin,
    camera_right: unitRight,
    camera_up: up,
    camera_forward: forward,
    lens_radius: 0,
    focus_distance: 1,
    lens_blades: 0,
    lens_rotation: 0,
    cone_width: 0,
  };
  if (camera.type === 'panorama')
    return { ...base, half_extent: [Math.PI, Math.PI / 2], cone_spread: Math.PI / height };
  if (camera.type === 'orthographic') {
    // The film's shape decides the width, as for perspective.
    return {
      ...base,
      half_extent: [(camera.ymag * width) / height, camera.ymag],
      cone_width: (2 * camera.ymag) / height,
      cone_spread: 0,
    };
  }
  const tangent = Math.tan(camera.yfov / 2);
  return {
    ...base,
    lens_radius: camera.lens_radius ?? 0,
    focus_distance: Math.max(camera.focus_distance ?? 1, 1e-6),
    lens_blades: Math.floor(camera.lens_blades ?? 0),
    lens_rotation: camera.lens_rotation ?? 0,
    half_extent: [(tangent * width) / height, tangent],
    cone_spread: (2 * tangent) / height,
  };
}

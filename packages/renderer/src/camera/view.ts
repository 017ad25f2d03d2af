import type { Camera } from '@glanz/scene';
import { RenderError } from '../errors';
import type { PixelFilter } from '../options';

/** Radii in pixels that the filters have when none is given. */
const RADII = { box: 0.5, gaussian: 1.5, 'blackman-harris': 1.5 } as const;

/**
 * A pixel filter with its radius.
 * @throws {RenderError} `renderer/filter` for an unknown filter or a radius out of range.
 */
export function resolveFilter(filter: PixelFilter = 'box'): {
  readonly type: keyof typeof RADII;
  readonly radius: number;
} {
  const { type, radius } = { radius: undefined, ...(typeof filter === 'string' ? { type: filter } : filter) };
  if (!Object.hasOwn(RADII, type))
    throw new RenderError(
      'renderer/filter',
      `There is no pixel filter ${JSON.stringify(type)}; known: ${Object.keys(RADII).join(', ')}.`,
    );
  if (radius !== undefined && !(radius > 0 && radius <= 16))
    throw new RenderError(
      'renderer/filter',
      `A pixel filter's radius must be above 0 and at most 16 pixels, not ${radius}.`,
    );
  return { type, radius: radius ?? RADII[type] };
}

/** What the camera and the filter say about the text of the kernels that start paths. */
export function viewFlags(camera: Camera, filter: PixelFilter | undefined): Readonly<Record<string, boolean>> {
  const { type, radius } = resolveFilter(filter);
  const lens = camera.type === 'perspective' && (camera.lens_radius ?? 0) > 0;
  return {
    CAMERA_ORTHOGRAPHIC: camera.type === 'orthographic',
    CAMERA_PANORAMA: camera.type === 'panorama',
    CAMERA_LENS: lens,
    CAMERA_BLADES: lens && (camera.lens_blades ?? 0) >= 3,
    // A box of another width is stretched in the shader like the others.
    FILTER_BOX: type === 'box' && radius === RADII.box,
    FILTER_WIDE_BOX: type === 'box' && radius !== RADII.box,
    FILTER_GAUSSIAN: type === 'gaussian',
    FILTER_BLACKMAN_HARRIS: type === 'blackman-harris',
  };
}

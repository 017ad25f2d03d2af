import type { Camera } from '@glanz/scene';
import type { PixelFilter } from '../options';
import { RENDER_OPTIONS } from '../render-options';

const RADII = RENDER_OPTIONS.filter.radii;

/** A pixel filter with its radius. @param filter Validated. */
export function resolveFilter(filter: PixelFilter): {
  readonly type: keyof typeof RADII;
  readonly radius: number;
} {
  const { type, radius } = { radius: undefined, ...(typeof filter === 'string' ? { type: filter } : filter) };
  return { type, radius: radius ?? RADII[type] };
}

/** What the camera and the filter say about the text of the kernels that start paths. */
export function viewFlags(camera: Camera, filter: PixelFilter): Readonly<Record<string, boolean>> {
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

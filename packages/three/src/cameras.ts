import type { Camera, PerspectiveCamera, Scene } from '@glanz/scene';
import { axisOf, positionOf } from './matrix';
import type { Loose, ThreeCamera } from './types';

/** A camera of three as one of the scene's; `undefined`, with a warning, for kinds that there are not. */
export function readCamera(camera: ThreeCamera, scene: Scene): Camera | undefined {
  const loose = camera as unknown as Loose;
  const m = camera.matrixWorld.elements;
  const transform = [...axisOf(m, 0), 0, ...axisOf(m, 1), 0, ...axisOf(m, 2), 0, ...positionOf(m), 1];
  const name = camera.name || (loose['type'] as string);
  const zoom = (loose['zoom'] as number | undefined) ?? 1;
  if ((loose['view'] as { readonly enabled?: boolean } | null | undefined)?.enabled)
    scene.warnings.push({
      code: 'three/camera',
      message: `Camera "${name}" has a view offset, which is not supported.`,
    });
  if (loose['isPerspectiveCamera'] === true) {
    const half = Math.tan((((loose['fov'] as number) / 2) * Math.PI) / 180) / zoom;
    // A canvas without a size gives an aspect of NaN or infinity, which the image's replaces.
    const usable = (key: 'aspect' | 'focus') => {
      const value = loose[key] as number | undefined;
      if (value === undefined || (value > 0 && value < Infinity)) return value;
      scene.warnings.push({
        code: 'three/camera',
        message: `Camera "${name}" has the ${key} ${value}, which is not supported.`,
      });
      return undefined;
    };
    const aspect = usable('aspect');
    const lens = lensOf(loose);
    if (((loose['anamorphicRatio'] as number | undefined) ?? 1) !== 1)
      scene.warnings.push({
        code: 'three/camera',
        message: `Camera "${name}" has an anamorphicRatio, which is not supported: its aperture is as wide as high.`,
      });
    const focus = lens.focus_distance === undefined ? usable('focus') : undefined;
    return {
      type: 'perspective',
      name,
      transform,
      yfov: 2 * Math.atan(half),
      ...(aspect === undefined ? {} : { aspect }),
      ...(focus === undefined ? {} : { focus_distance: focus }),
      ...lens,
    };
  }
  if (loose['isOrthographicCamera'] === true) {
    const [left, right, top, bottom] = [loose['left'], loose['right'], loose['top'], loose['bottom']] as [
      number,
      number,
      number,
      number,
    ];
    // A frustum that is off its axis looks from beside it.
    const [dx, dy] = [(left + right) / 2, (top + bottom) / 2];
    for (let k = 0; k < 3; k++)
      transform[12 + k] =
        (transform[12 + k] as number) + dx * (transform[k] as number) + dy * (transform[4 + k] as number);
    return { type: 'orthographic', name, transform, xmag: (right - left) / 2 / zoom, ymag: (top - bottom) / 2 / zoom };
  }
  if (loose['isEquirectCamera'] === true) return { type: 'panorama', name, transform };
  scene.warnings.push({
    code: 'three/camera',
    message: `Camera "${name}" of type ${String(loose['type'])} is not supported.`,
  });
  return undefined;
}

/**
 * The lens of a `PhysicalCamera`, by its fields `fStop`, `focusDistance`, `apertureBlades` and `apertureRotation`; none of
 * another camera. Its focal length is in millimetres of the film, and the scene's unit a metre.
 */
function lensOf(loose: Loose): Partial<PerspectiveCamera> {
  const {
    fStop,
    focusDistance,
    apertureBlades = 0,
    apertureRotation = 0,
  } = loose as Record<string, number | undefined>;
  if (!(fStop !== undefined && fStop > 0) || !(focusDistance !== undefined && focusDistance > 0)) return {};
  const focalLength = (loose as unknown as { getFocalLength(): number }).getFocalLength();
  return {
    lens_radius: (0.5e-3 * focalLength) / fStop,
    lens_blades: apertureBlades,
    lens_rotation: apertureRotation,
    focus_distance: focusDistance,
  };
}

import type { Camera, Scene } from '@glanz/scene';
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
    const aspect = usable('aspect'),
      focus = usable('focus');
    return {
      type: 'perspective',
      name,
      transform,
      yfov: 2 * Math.atan(half),
      ...(aspect === undefined ? {} : { aspect }),
      ...(focus === undefined ? {} : { focus_distance: focus }),
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
  scene.warnings.push({
    code: 'three/camera',
    message: `Camera "${name}" of type ${String(loose['type'])} is not supported.`,
  });
  return undefined;
}

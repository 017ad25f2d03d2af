import type { CheckContext } from './context';
import { isObject, own, quote, type Raw } from '../json-value';

/**
 * Lights of EXT_lights_image_based in order, undefined in place of an invalid one; undefined if there are none.
 */
export function repairImageLights(context: CheckContext): readonly (Raw | undefined)[] | undefined {
  const extensions = own(context.json, 'extensions');
  const extension = isObject(extensions) ? own(extensions, 'EXT_lights_image_based') : undefined;
  if (extension === undefined) return undefined;
  const path = '/extensions/EXT_lights_image_based/lights';
  const lights = isObject(extension) ? own(extension, 'lights') : undefined;
  if (!Array.isArray(lights)) {
    context.warn('gltf/environment', path, `is ${quote(lights)}, but must be an array; the environment is left out`);
    return undefined;
  }
  const images = context.list('images').length;
  const isFace = (value: unknown) =>
    typeof value === 'number' && Number.isInteger(value) && value >= 0 && value < images;
  return lights.map((light: unknown, index) => {
    const at = `${path}/${index}`;
    const lost = (what: string) => {
      context.warn('gltf/environment', at, `${what}; it is left out`);
      return undefined;
    };
    if (!isObject(light)) return lost(`is ${quote(light)}, but must be an object`);
    const levels = own(light, 'specularImages');
    if (
      !Array.isArray(levels) ||
      levels.length === 0 ||
      !levels.every((faces: unknown) => Array.isArray(faces) && faces.length === 6 && faces.every(isFace))
    )
      return lost(`has the images ${quote(levels)}, but must have six existing ones for each level`);
    const intensity = own(light, 'intensity') ?? 1;
    if (!(typeof intensity === 'number' && intensity >= 0 && intensity <= 1e30))
      return lost(`has the intensity ${quote(intensity)}`);
    const rotation = own(light, 'rotation') ?? [0, 0, 0, 1];
    const length =
      Array.isArray(rotation) && rotation.length === 4 && rotation.every((x) => typeof x === 'number')
        ? Math.hypot(...(rotation as number[]))
        : NaN;
    if (!(length > 1e-6 && length < Infinity)) return lost(`has the rotation ${quote(rotation)}`);
    const size = own(light, 'specularImageSize');
    return {
      specularImages: levels,
      intensity,
      rotation: (rotation as number[]).map((x) => x / length),
      ...(typeof size === 'number' && size > 0 && size < 65536 ? { specularImageSize: size } : {}),
    };
  });
}

import type { MATERIAL_EXTENSIONS } from '../json';
import type { CheckContext } from './context';
import { isObject, own, quote, type Raw } from '../json-value';

/** The largest number that single precision holds: shaders know no larger one. */
const LARGEST = 3.4e38;

/** Factors by the object that holds them: name, how many numbers (0: one, not in an array), initial value, range. */
type Factor = readonly [key: string, size: number, initial: number, low: number, high: number];

const CORE: readonly Factor[] = [
  ['emissiveFactor', 3, 0, 0, LARGEST],
  ['alphaCutoff', 0, 0.5, 0, LARGEST],
];
const METALLIC_ROUGHNESS: readonly Factor[] = [
  ['baseColorFactor', 4, 1, 0, 1],
  ['metallicFactor', 0, 1, 0, 1],
  ['roughnessFactor', 0, 1, 0, 1],
];
const EXTENSIONS: Readonly<Record<(typeof MATERIAL_EXTENSIONS)[number], readonly Factor[]>> = {
  KHR_materials_anisotropy: [
    ['anisotropyStrength', 0, 0, 0, 1],
    ['anisotropyRotation', 0, 0, -LARGEST, LARGEST],
  ],
  KHR_materials_clearcoat: [
    ['clearcoatFactor', 0, 0, 0, 1],
    ['clearcoatRoughnessFactor', 0, 0, 0, 1],
  ],
  KHR_materials_diffuse_transmission: [
    ['diffuseTransmissionFactor', 0, 0, 0, 1],
    ['diffuseTransmissionColorFactor', 3, 1, 0, 1],
  ],
  KHR_materials_dispersion: [['dispersion', 0, 0, 0, 1000]],
  KHR_materials_emissive_strength: [['emissiveStrength', 0, 1, 0, LARGEST]],
  KHR_materials_ior: [['ior', 0, 1.5, 0, 1000]],
  KHR_materials_iridescence: [
    ['iridescenceFactor', 0, 0, 0, 1],
    ['iridescenceIor', 0, 1.3, 1, 1000],
    ['iridescenceThicknessMinimum', 0, 100, 0, 1e9],
    ['iridescenceThicknessMaximum', 0, 400, 0, 1e9],
  ],
  KHR_materials_pbrSpecularGlossiness: [
    ['diffuseFactor', 4, 1, 0, 1],
    ['specularFactor', 3, 1, 0, 1],
    ['glossinessFactor', 0, 1, 0, 1],
  ],
  KHR_materials_sheen: [
    ['sheenColorFactor', 3, 0, 0, 1],
    ['sheenRoughnessFactor', 0, 0, 0, 1],
  ],
  KHR_materials_specular: [
    ['specularFactor', 0, 1, 0, 1],
    ['specularColorFactor', 3, 1, 0, LARGEST],
  ],
  KHR_materials_transmission: [['transmissionFactor', 0, 0, 0, 1]],
  KHR_materials_unlit: [],
  // A distance of 0 would let no light through at all; exporters write it for "none", which is infinite.
  KHR_materials_volume: [
    ['thicknessFactor', 0, 0, 0, LARGEST],
    ['attenuationDistance', 0, Infinity, 0, Infinity],
    ['attenuationColor', 3, 1, 0, 1],
  ],
  KHR_materials_volume_scatter: [
    ['multiscatterColor', 3, 0, 0, 1],
    ['multiscatterColorFactor', 3, 0, 0, 1],
    ['scatterAnisotropy', 0, 0, -1, 1],
  ],
};
const TRANSFORM: readonly Factor[] = [
  ['offset', 2, 0, -LARGEST, LARGEST],
  ['scale', 2, 1, -LARGEST, LARGEST],
  ['rotation', 0, 0, -LARGEST, LARGEST],
];
const TEXTURES = /Texture$/;

/**
 * An object with its factors clamped to their ranges, with a warning; a factor that is not a number gets its default.
 */
function factorsOf(context: CheckContext, object: Raw, path: string, factors: readonly Factor[]): Raw {
  const repaired: Record<string, unknown> = {};
  for (const [key, size, initial, low, high] of factors) {
    const value = own(object, key);
    if (value === undefined) continue;
    const clamp = (x: unknown) =>
      typeof x === 'number' && !Number.isNaN(x) ? Math.min(Math.max(x, low), high) : initial;
    const good =
      size === 0
        ? clamp(value)
        : Array.from({ length: size }, (_, i) => clamp(Array.isArray(value) ? value[i] : undefined));
    repaired[key] = good;
    // Exporters write 1.00000012 for 1: do not warn of rounding.
    const near = (x: unknown, y: number) => typeof x === 'number' && Math.abs(x - y) <= 1e-5;
    const same =
      size === 0
        ? near(value, good as number)
        : Array.isArray(value) &&
          value.length === size &&
          value.every((x, i) => near(x, (good as number[])[i] as number));
    if (!same) context.warn('gltf/material', `${path}/${key}`, `is ${quote(value)}; ${quote(good)} is taken`);
  }
  return { ...object, ...repaired };
}

/** An object with valid textures: each an object with an integer index, or absent. */
function texturesOf(context: CheckContext, object: Raw, path: string): Raw {
  const repaired: Record<string, unknown> = { ...object };
  for (const [key, info] of Object.entries(object)) {
    if (!TEXTURES.test(key)) continue;
    const at = `${path}/${key}`;
    if (
      !isObject(info) ||
      !Number.isInteger(info['index']) ||
      (info['texCoord'] !== undefined && !Number.isInteger(info['texCoord']))
    ) {
      context.warn('gltf/texture', at, `is ${quote(info)}, which is not a texture; it is left out`);
      delete repaired[key];
      continue;
    }
    if (!((info['index'] as number) >= 0 && (info['index'] as number) < context.list('textures').length)) {
      context.warn(
        'gltf/texture',
        at,
        `refers to texture ${info['index'] as number}, which does not exist; it is left out`,
      );
      delete repaired[key];
      continue;
    }
    const scaled = factorsOf(context, info, at, [['scale', 0, 1, -LARGEST, LARGEST]]);
    const extensions = own(info, 'extensions');
    const transform = isObject(extensions) ? own(extensions, 'KHR_texture_transform') : undefined;
    const { extensions: _, ...rest } = scaled;
    repaired[key] = isObject(transform)
      ? {
          ...rest,
          extensions: {
            KHR_texture_transform: factorsOf(context, transform, `${at}/extensions/KHR_texture_transform`, TRANSFORM),
          },
        }
      : rest;
  }
  return repaired;
}

/** Materials with every number that is read in its range, and only the extensions that are read. */
export function repairMaterials(context: CheckContext): readonly Raw[] {
  return context.list('materials').map((material, index) => {
    const path = `/materials/${index}`;
    const repaired: Record<string, unknown> = {
      ...texturesOf(context, factorsOf(context, material, path, CORE), path),
    };
    if (own(material, 'name') !== undefined && typeof material['name'] !== 'string') delete repaired['name'];
    const mode = own(material, 'alphaMode');
    if (mode !== undefined && mode !== 'OPAQUE' && mode !== 'MASK' && mode !== 'BLEND') {
      context.warn('gltf/material', `${path}/alphaMode`, `is ${quote(mode)}; OPAQUE is taken`);
      delete repaired['alphaMode'];
    }
    const pbr = own(material, 'pbrMetallicRoughness');
    if (isObject(pbr))
      repaired['pbrMetallicRoughness'] = texturesOf(
        context,
        factorsOf(context, pbr, `${path}/pbrMetallicRoughness`, METALLIC_ROUGHNESS),
        `${path}/pbrMetallicRoughness`,
      );
    else if (pbr !== undefined) {
      context.warn('gltf/material', `${path}/pbrMetallicRoughness`, `is ${quote(pbr)}; it is left out`);
      delete repaired['pbrMetallicRoughness'];
    }
    repaired['extensions'] = repairExtensions(context, own(material, 'extensions'), `${path}/extensions`);
    return repaired;
  });
}

function repairExtensions(context: CheckContext, extensions: unknown, path: string): Raw {
  const repaired: Record<string, unknown> = {};
  if (!isObject(extensions)) {
    if (extensions !== undefined) context.warn('gltf/material', path, `is ${quote(extensions)}; it is left out`);
    return repaired;
  }
  for (const [name, value] of Object.entries(extensions)) {
    const at = `${path}/${name}`;
    if (!isObject(value)) context.warn('gltf/material', at, `is ${quote(value)}; it is left out`);
    else if (Object.hasOwn(EXTENSIONS, name))
      repaired[name] = texturesOf(
        context,
        factorsOf(context, value, at, EXTENSIONS[name as keyof typeof EXTENSIONS]),
        at,
      );
  }
  return repaired;
}

/** Lights of KHR_lights_punctual in order; undefined if there are none. */
export function repairLights(context: CheckContext): readonly Raw[] | undefined {
  const extensions = own(context.json, 'extensions');
  const extension = isObject(extensions) ? own(extensions, 'KHR_lights_punctual') : undefined;
  if (extension === undefined) return undefined;
  const path = '/extensions/KHR_lights_punctual/lights';
  const lights = isObject(extension) ? own(extension, 'lights') : undefined;
  if (!Array.isArray(lights)) {
    context.warn('gltf/light', path, `is ${quote(lights)}, but must be an array; there are no lights`);
    return [];
  }
  // Indices must not change, so an invalid light becomes a dark one.
  return lights.map((light: unknown, index) => {
    const at = `${path}/${index}`;
    if (!isObject(light) || !['point', 'spot', 'directional'].includes(light['type'] as string)) {
      context.warn('gltf/light', at, 'has no type that is known; it stays dark');
      return { type: 'point', intensity: 0 };
    }
    const { intensity = 1, color = [1, 1, 1], name, spot } = light;
    const number = (value: unknown): value is number => typeof value === 'number' && value >= 0 && value <= LARGEST;
    if (!number(intensity) || !Array.isArray(color) || color.length !== 3 || !color.every(number)) {
      context.warn(
        'gltf/light',
        at,
        `has the colour ${quote(color)} and the intensity ${quote(intensity)}; it stays dark`,
      );
      return { type: light['type'], intensity: 0, ...(light['type'] === 'spot' ? { spot: {} } : {}) };
    }
    const made: Record<string, unknown> = { type: light['type'], intensity, color };
    if (typeof name === 'string') made['name'] = name;
    if (light['type'] === 'spot') {
      if (!isObject(spot)) context.warn('gltf/light', `${at}/spot`, "is missing; glTF's initial cone is taken");
      const [inner, outer] = (['innerConeAngle', 'outerConeAngle'] as const).map((key) =>
        isObject(spot) ? own(spot, key) : undefined,
      );
      if (!areConeAngles(inner ?? 0, outer ?? Math.PI / 4)) {
        context.warn(
          'gltf/light',
          `${at}/spot`,
          `has the cone angles ${quote(inner)} and ${quote(outer)}, but must have 0 ≤ inner < outer ≤ π/2; they are clamped`,
        );
      }
      const angle = (key: string) => (isObject(spot) && number(own(spot, key)) ? { [key]: own(spot, key) } : {});
      made['spot'] = { ...angle('innerConeAngle'), ...angle('outerConeAngle') };
    }
    return made;
  });
}

/** Exporters write π/2 in single precision. */
const areConeAngles = (inner: unknown, outer: unknown): boolean =>
  typeof inner === 'number' && typeof outer === 'number' && inner >= 0 && inner < outer && outer <= Math.PI / 2 + 1e-6;

/** Cameras in order; indices must not change, so an invalid one is kept, and the loader leaves it out. */
export function repairCameras(context: CheckContext): readonly Raw[] {
  return context.list('cameras').map((camera, index) => {
    const path = `/cameras/${index}`;
    const number = (value: unknown) => (typeof value === 'number' && Number.isFinite(value) ? value : 0);
    const name = typeof camera['name'] === 'string' ? { name: camera['name'] } : {};
    const orthographic = own(camera, 'orthographic'),
      perspective = own(camera, 'perspective');
    const type = own(camera, 'type');
    if (type !== 'perspective' && type !== 'orthographic')
      context.warn(
        'gltf/camera',
        `${path}/type`,
        `is ${quote(type)}, but must be "perspective" or "orthographic"; perspective is taken`,
      );
    if (orthographic !== undefined && perspective !== undefined)
      context.warn('gltf/camera', path, `is both perspective and orthographic; its type is ${quote(type)}`);
    if (type === 'orthographic') {
      const { xmag, ymag, znear, zfar } = isObject(orthographic) ? orthographic : ({} as Raw);
      return {
        ...name,
        type: 'orthographic',
        orthographic: { xmag: number(xmag), ymag: number(ymag), znear: number(znear), zfar: number(zfar) },
      };
    }
    const { yfov, aspectRatio, znear } = isObject(perspective) ? perspective : ({} as Raw);
    if (aspectRatio !== undefined && !(number(aspectRatio) > 0))
      context.warn(
        'gltf/camera',
        `${path}/perspective/aspectRatio`,
        `is ${quote(aspectRatio)}, but must be above 0; the image's is taken`,
      );
    return {
      ...name,
      type: 'perspective',
      perspective: { yfov: number(yfov), znear: number(znear), ...(number(aspectRatio) > 0 ? { aspectRatio } : {}) },
    };
  });
}

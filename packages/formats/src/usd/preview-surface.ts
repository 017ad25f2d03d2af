import type { Material, TexturedParameter } from '@glanz/scene';
import { numberOf, textOf, type UsdPrim } from './layer';
import { inputOf, type PrimFinder, type UsdTexture } from './network';

/** An image that drives a parameter of a material. */
export interface UsdMap {
  readonly parameter: TexturedParameter;
  readonly texture: UsdTexture;
  readonly colorSpace: 'srgb' | 'linear';
  /** What texel values 0 and 1 map to, before they multiply the parameter. */
  readonly range?: readonly [number, number];
}

/** A material with the images that it needs, and the names of its texture coordinates. */
export interface UsdMaterial {
  readonly material: Material;
  readonly maps: readonly UsdMap[];
  /** At most two, in the order of the mesh's UV sets. */
  readonly uvs: readonly string[];
}

type Color = readonly [number, number, number];
type Parameters = { -readonly [Name in keyof Material['parameters']]: Material['parameters'][Name] };

/** The largest reflectance at normal incidence that an index stands for. */
const LARGEST_REFLECTANCE = 0.98;
const MAX_UVS = 2;
const limit = (value: number, low = 0, high = 1) => Math.min(Math.max(value, low), high);

/** value·(at0 + (at1 − at0)·texel) as scale·texel + bias: the same factor for all channels, or none. */
function product(scale: readonly number[], bias: readonly number[]) {
  const value = scale.map((s, k) => s + (bias[k] as number));
  const from = value.map((v, k) => (v === 0 ? undefined : (bias[k] as number) / v));
  const first = from.find((at) => at !== undefined) ?? 0;
  return from.every((at) => at === undefined || Math.abs(at - first) < 1e-6) ? { value, from: first } : undefined;
}

/**
 * A USD material by its `UsdPreviewSurface` (UsdPreviewSurface Specification 2.6) as OpenPBR.
 *
 * | UsdPreviewSurface | OpenPBR | lost |
 * |---|---|---|
 * | diffuseColor (0.18) | base_color | nothing |
 * | metallic | base_metalness | nothing |
 * | useSpecularWorkflow, specularColor | base_metalness 0, specular_ior by the brightest channel, specular_color | images of the specular colour; the white edge of a tinted reflection |
 * | roughness (0.5) | specular_roughness | nothing |
 * | ior | specular_ior | nothing |
 * | clearcoat, clearcoatRoughness (0.01) | coat_weight, coat_roughness, coat_ior 1.5, coat_darkening 0 | nothing |
 * | emissiveColor | emission_color, emission_luminance 1 | nothing |
 * | opacity, opacityMode `transparent` | transmission_weight = 1 − opacity, geometry_thin_walled | refraction, which USD leaves to the renderer |
 * | opacity, opacityMode `presence` | geometry_opacity | nothing |
 * | opacityThreshold above 0 | geometry_opacity with the threshold | nothing |
 * | normal | geometry_normal | a scale other than 2 and a bias other than −1 |
 * | occlusion | | all of it: light finds its way by itself |
 * | displacement | | all of it |
 *
 * @param warn Receives what is left out.
 */
export function previewSurface(
  prim: UsdPrim,
  find: PrimFinder,
  warn: (message: string) => void,
): UsdMaterial | undefined {
  const target = prim.attributes.get('outputs:surface')?.connections?.[0];
  const shader = target === undefined ? undefined : find(target.slice(0, target.lastIndexOf('.')));
  if (!shader || textOf(shader, 'info:id') !== 'UsdPreviewSurface') {
    warn('has no UsdPreviewSurface; the default one is used');
    return undefined;
  }
  const parameters: Parameters = {};
  const maps: UsdMap[] = [];
  const uvs: string[] = [];
  const addMap = (map: UsdMap): boolean => {
    const { uv } = map.texture;
    if (!uvs.includes(uv) && uvs.push(uv) > MAX_UVS) {
      uvs.pop();
      warn(`reads more than ${MAX_UVS} sets of texture coordinates; "${map.texture.file}" is left out`);
      return false;
    }
    maps.push(map);
    return true;
  };
  /** A colour or number with its image; whether the file sets it. */
  const take = (
    name: string,
    initial: number | Color,
    parameter: TexturedParameter,
    colorSpace: 'srgb' | 'linear',
    invert = false,
  ): boolean => {
    const input = inputOf(shader, name, find);
    const size = typeof initial === 'number' ? 1 : 3;
    const set = (values: readonly number[]) =>
      Object.assign(parameters, { [parameter]: size === 1 ? values[0] : values.slice(0, 3) });
    const plain = (values: readonly number[]) => set(invert ? values.map((x) => 1 - x) : values);
    if (input === 'unsupported') warn(`has a ${name} that is driven by what is not read; the default is used`);
    if (input === undefined || input === 'unsupported') {
      plain([initial].flat());
      return false;
    }
    if ('value' in input) {
      const values = [input.value].flat(1) as unknown as ArrayLike<number>;
      const numbers = Array.from(typeof input.value === 'object' ? (input.value as ArrayLike<number>) : values, Number);
      const good = numbers.length >= size && numbers.every(Number.isFinite);
      plain(good ? numbers : [initial].flat());
      return good;
    }
    const { texture } = input;
    const space = texture.colorSpace === 'auto' ? colorSpace : texture.colorSpace === 'sRGB' ? 'srgb' : 'linear';
    const [scale, bias] = invert
      ? [texture.scale.map((s) => -s), texture.bias.map((b) => 1 - b)]
      : [texture.scale, texture.bias];
    // 1 − texel is 0 at 1: its largest value is that at 0.
    if (invert) {
      const [s = 0, b = 0] = [scale[0], bias[0]];
      set([1]);
      return addMap({ parameter, texture, colorSpace: space, range: [b, s + b] });
    }
    const factor = product(scale, bias);
    if (!factor) {
      warn(`shifts the channels of "${texture.file}" apart, which is not read; its ${name} keeps the default`);
      plain([initial].flat());
      return false;
    }
    set(factor.value.length === 1 && size === 3 ? [0, 1, 2].map(() => factor.value[0] as number) : factor.value);
    return addMap({
      parameter,
      texture,
      colorSpace: space,
      ...(factor.from === 0 ? {} : { range: [factor.from, 1] as const }),
    });
  };

  take('diffuseColor', [0.18, 0.18, 0.18], 'base_color', 'srgb');
  take('roughness', 0.5, 'specular_roughness', 'linear');
  take('ior', 1.5, 'specular_ior', 'linear');
  if (numberOf(shader, 'inputs:useSpecularWorkflow') === 1) {
    const input = inputOf(shader, 'specularColor', find);
    if (input && input !== 'unsupported' && 'value' in input && typeof input.value === 'object') {
      const given = Array.from(input.value as ArrayLike<number>, (c) => limit(Number(c)));
      const brightest = Math.max(...given);
      const root = Math.sqrt(Math.min(brightest, LARGEST_REFLECTANCE));
      parameters.specular_ior = (1 + root) / (1 - root);
      if (brightest > 0) parameters.specular_color = given.map((c) => c / brightest) as unknown as Color;
    } else if (input) warn('has an image of the specular colour, which is not read; the index is used');
  } else take('metallic', 0, 'base_metalness', 'linear');
  if (inputOf(shader, 'clearcoat', find) !== undefined) {
    take('clearcoat', 0, 'coat_weight', 'linear');
    take('clearcoatRoughness', 0.01, 'coat_roughness', 'linear');
    parameters.coat_ior = 1.5;
    parameters.coat_darkening = 0;
  }
  if (take('emissiveColor', [0, 0, 0], 'emission_color', 'srgb')) parameters.emission_luminance = 1;
  else delete parameters.emission_color;
  const normal = inputOf(shader, 'normal', find);
  if (normal && normal !== 'unsupported' && 'texture' in normal)
    addMap({ parameter: 'geometry_normal', texture: normal.texture, colorSpace: 'linear' });
  if (inputOf(shader, 'displacement', find) !== undefined) warn('has a displacement, which is left out');

  const material: Material = { name: prim.name, parameters };
  const threshold = numberOf(shader, 'inputs:opacityThreshold') ?? 0;
  if (threshold > 0 || textOf(shader, 'inputs:opacityMode') === 'presence') {
    take('opacity', 1, 'geometry_opacity', 'linear');
    if (threshold > 0) material.opacity_threshold = limit(threshold);
  } else {
    take('opacity', 1, 'transmission_weight', 'linear', true);
    if ((parameters.transmission_weight ?? 0) > 0) parameters.geometry_thin_walled = true;
    else delete parameters.transmission_weight;
  }
  clampParameters(parameters);
  return { material, maps, uvs };
}

/** Values in OpenPBR's ranges: files hold any. */
function clampParameters(parameters: Parameters): void {
  for (const [name, value] of Object.entries(parameters) as [keyof Parameters, unknown][]) {
    const high = name === 'emission_color' ? Number.MAX_SAFE_INTEGER : name.endsWith('_ior') ? 1000 : 1;
    const low = name.endsWith('_ior') ? 1e-3 : 0;
    if (typeof value === 'number' && name !== 'emission_luminance')
      Object.assign(parameters, { [name]: limit(value, low, high) });
    else if (Array.isArray(value)) Object.assign(parameters, { [name]: value.map((c: number) => limit(c, low, high)) });
  }
}

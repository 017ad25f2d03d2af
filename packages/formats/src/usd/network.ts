import type { TextureBinding } from '@glanz/scene';
import { numberOf, numbersOf, textOf, type UsdPrim, type UsdValue } from './layer';

/** Finds prims by their paths. */
export type PrimFinder = (path: string) => UsdPrim | undefined;

/** An image that a shader reads. */
export interface UsdTexture {
  readonly file: string;
  readonly channels: 'rgb' | 'r' | 'g' | 'b' | 'a';
  readonly colorSpace: 'auto' | 'raw' | 'sRGB';
  /** Name of the primvar with the coordinates. */
  readonly uv: string;
  readonly transform?: TextureBinding['transform'];
  readonly wrap: readonly ['repeat' | 'mirror' | 'clamp', 'repeat' | 'mirror' | 'clamp'];
  /** value = scale × texel + bias, in the order of the channels that are read. */
  readonly scale: readonly number[];
  readonly bias: readonly number[];
}

/** What an input is set to: a value, or an image. */
export type UsdInput = { readonly value: UsdValue } | { readonly texture: UsdTexture };

/** Longer chains of connections are a circle, or as good as one. */
const LONGEST = 32;
const CHANNELS: Readonly<Record<string, UsdTexture['channels']>> = { rgb: 'rgb', r: 'r', g: 'g', b: 'b', a: 'a' };
const wrapOf = (token: string | undefined) =>
  // Beyond a black border Glanz repeats the image's edge.
  token === 'mirror' ? 'mirror' : token === 'clamp' || token === 'black' ? 'clamp' : 'repeat';

/** Where a connection leads: the prim and the property. */
function endOf(path: string, find: PrimFinder): { readonly prim: UsdPrim; readonly property: string } | undefined {
  const dot = path.lastIndexOf('.');
  const prim = dot < 0 ? undefined : find(path.slice(0, dot));
  return prim && { prim, property: path.slice(dot + 1) };
}

/** Follows an input through interfaces of materials and node graphs to where its value is, or an output. */
function follow(start: UsdPrim, name: string, find: PrimFinder) {
  let prim = start,
    property = name;
  for (let i = 0; i < LONGEST; i++) {
    const attribute = prim.attributes.get(property);
    const target = attribute?.connections?.[0];
    if (target === undefined || target === '')
      return attribute?.value === undefined ? undefined : { prim, property, value: attribute.value };
    const end = endOf(target, find);
    if (!end) return undefined;
    ({ prim, property } = end);
    if (property.startsWith('outputs:') && prim.type === 'Shader') return { prim, property, value: undefined };
  }
  return undefined;
}

/** Coordinates of a texture: the primvar, and its map of coordinates whose v runs down, as {@link TextureBinding}'s. */
function coordinatesOf(texture: UsdPrim, find: PrimFinder): Pick<UsdTexture, 'uv' | 'transform'> | undefined {
  let [a, b, c, d, x, y] = [1, 0, 0, 1, 0, 0];
  let end = follow(texture, 'inputs:st', find);
  for (let i = 0; end && i < LONGEST; i++) {
    const id = textOf(end.prim, 'info:id');
    if (id === 'UsdTransform2d') {
      const [sx = 1, sy = 1] = Array.from(numbersOf(end.prim, 'inputs:scale') ?? []);
      const [tx = 0, ty = 0] = Array.from(numbersOf(end.prim, 'inputs:translation') ?? []);
      const angle = ((numberOf(end.prim, 'inputs:rotation') ?? 0) * Math.PI) / 180;
      const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
      // What was found so far is applied after this one: scale, rotation, translation, in this order.
      const [e, f, g, h] = [cos * sx, sin * sx, -sin * sy, cos * sy];
      [a, b, c, d, x, y] = [
        a * e + c * f,
        b * e + d * f,
        a * g + c * h,
        b * g + d * h,
        a * tx + c * ty + x,
        b * tx + d * ty + y,
      ];
      end = follow(end.prim, 'inputs:in', find);
      continue;
    }
    if (id?.startsWith('UsdPrimvarReader')) {
      const name = follow(end.prim, 'inputs:varname', find)?.value;
      const moved = [a - 1, b, c, d - 1, x, y].some((difference) => Math.abs(difference) > 1e-12);
      return {
        uv: typeof name === 'string' ? name : 'st',
        ...(moved ? { transform: [a, -b, -c, d, c + x, 1 - d - y].map((k) => k + 0) as never } : {}),
      };
    }
    return undefined;
  }
  return texture.attributes.has('inputs:st') ? undefined : { uv: 'st' };
}

/**
 * What an input of a shader is set to; undefined for its default. A network that is not read gives `unsupported`.
 */
export function inputOf(shader: UsdPrim, name: string, find: PrimFinder): UsdInput | 'unsupported' | undefined {
  const end = follow(shader, `inputs:${name}`, find);
  if (!end) return shader.attributes.get(`inputs:${name}`)?.connections?.length ? 'unsupported' : undefined;
  if (end.value !== undefined) return { value: end.value };
  const { prim, property } = end;
  const channels = CHANNELS[property.slice('outputs:'.length)];
  const file = follow(prim, 'inputs:file', find)?.value;
  const coordinates = coordinatesOf(prim, find);
  if (textOf(prim, 'info:id') !== 'UsdUVTexture' || !channels || typeof file !== 'string' || !coordinates)
    return 'unsupported';
  const space = textOf(prim, 'inputs:sourceColorSpace');
  const picked = (input: string, initial: number) => {
    const values = numbersOf(prim, input) ?? [];
    return (channels === 'rgb' ? [0, 1, 2] : ['rgba'.indexOf(channels)]).map((k) => values[k] ?? initial);
  };
  return {
    texture: {
      file,
      channels,
      colorSpace: space === 'raw' || space === 'sRGB' ? space : 'auto',
      ...coordinates,
      wrap: [wrapOf(textOf(prim, 'inputs:wrapS')), wrapOf(textOf(prim, 'inputs:wrapT'))],
      scale: picked('inputs:scale', 1),
      bias: picked('inputs:bias', 0),
    },
  };
}

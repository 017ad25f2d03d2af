/** An affine map of texture coordinates `[a, b, c, d, x, y]`: u' = a·u + c·v + x, v' = b·u + d·v + y. */
export type Affine = readonly [number, number, number, number, number, number];

/** An image and the way to read it. */
export interface TextureLookup {
  readonly file: string;
  readonly colorSpace: 'srgb' | 'linear';
  readonly uv: number;
  /** In MaterialX's coordinates, where v runs up. */
  readonly transform: Affine;
  readonly wrapU: 'repeat' | 'mirror' | 'clamp';
  readonly wrapV: 'repeat' | 'mirror' | 'clamp';
  readonly filter: 'linear' | 'nearest';
}

/** What a node is worth, as far as a material with textures can hold it. */
export type Expression =
  | { readonly kind: 'constant'; readonly values: readonly number[] }
  | {
      /** offset + scale × texel, per component. */
      readonly kind: 'texture';
      readonly texture: TextureLookup;
      /** How many components; those of `channels`, or the one of them everywhere. */
      readonly width: number;
      readonly channels: 'rgb' | 'rgba' | 'r' | 'g' | 'b' | 'a';
      readonly scale: readonly number[];
      readonly offset: readonly number[];
    }
  | { readonly kind: 'coordinates'; readonly uv: number; readonly transform: Affine }
  /** A tangent-space normal map. */
  | { readonly kind: 'normal map'; readonly texture: TextureLookup; readonly scale: number }
  /** In the frame of the surface. */
  | { readonly kind: 'direction'; readonly vector: readonly [number, number, number] };

/** Thrown where a node is worth more than an {@link Expression} can hold; caught before anyone sees it. */
export class Unsupported extends Error {}

const spread = (values: readonly number[], width: number): readonly number[] =>
  values.length === 1 ? Array.from({ length: width }, () => values[0] as number) : values;
const zip = (
  a: readonly number[],
  b: readonly number[],
  combine: (x: number, y: number) => number,
): readonly number[] => {
  const width = Math.max(a.length, b.length);
  const [left, right] = [spread(a, width), spread(b, width)];
  if (left.length !== right.length) throw new Unsupported('mixes numbers of different sizes');
  return left.map((x, i) => combine(x, right[i] as number));
};

/** The second map after the first. */
export function after(first: Affine, [a, b, c, d, x, y]: Affine): Affine {
  const [fa, fb, fc, fd, fx, fy] = first;
  return [a * fa + c * fb, b * fa + d * fb, a * fc + c * fd, b * fc + d * fd, a * fx + c * fy + x, b * fx + d * fy + y];
}

/** Components of a texture together with a constant. */
function widthOf(width: number, { length }: readonly number[]): number {
  if (width > 1 && length > 1 && width !== length) throw new Unsupported('mixes numbers of different sizes');
  return Math.max(width, length);
}

const TIMES = (x: number, y: number) => x * y;
const PLUS = (x: number, y: number) => x + y;
const pair = (values: readonly number[]) => spread(values, 2) as readonly [number, number];

export function multiply(left: Expression, right: Expression): Expression {
  if (left.kind === 'constant' && right.kind === 'constant')
    return { kind: 'constant', values: zip(left.values, right.values, TIMES) };
  if (left.kind === 'constant') return multiply(right, left);
  if (right.kind === 'constant') {
    if (left.kind === 'texture')
      return {
        ...left,
        width: widthOf(left.width, right.values),
        scale: zip(left.scale, right.values, TIMES),
        offset: zip(left.offset, right.values, TIMES),
      };
    if (left.kind === 'coordinates')
      return { ...left, transform: after(left.transform, [pair(right.values)[0], 0, 0, pair(right.values)[1], 0, 0]) };
  }
  throw new Unsupported('multiplies two textures');
}

export function add(left: Expression, right: Expression): Expression {
  if (left.kind === 'constant' && right.kind === 'constant')
    return { kind: 'constant', values: zip(left.values, right.values, PLUS) };
  if (left.kind === 'constant') return add(right, left);
  if (right.kind === 'constant') {
    if (left.kind === 'texture')
      return {
        ...left,
        width: widthOf(left.width, right.values),
        scale: zip(left.scale, right.values, (x) => x),
        offset: zip(left.offset, right.values, PLUS),
      };
    if (left.kind === 'coordinates')
      return { ...left, transform: after(left.transform, [1, 0, 0, 1, ...pair(right.values)]) };
  }
  throw new Unsupported('adds two textures');
}

export const constant = (...values: number[]): Expression => ({ kind: 'constant', values });

export function negate(value: Expression): Expression {
  return multiply(value, constant(-1));
}

/** 1 / value, of a constant. */
export function reciprocal(value: Expression): Expression {
  if (value.kind !== 'constant' || value.values.includes(0)) throw new Unsupported('divides by a texture or by 0');
  return { kind: 'constant', values: value.values.map((x) => 1 / x) };
}

/** One component of a value. */
export function component(value: Expression, index: number): Expression {
  if (value.kind === 'constant' && value.values[index] !== undefined) return constant(value.values[index]);
  if (value.kind === 'texture' && index < value.width) {
    const channels = value.channels.length === 1 ? value.channels : (['r', 'g', 'b', 'a'] as const)[index];
    if (channels)
      return {
        ...value,
        width: 1,
        channels,
        scale: [spread(value.scale, value.width)[index] as number],
        offset: [spread(value.offset, value.width)[index] as number],
      };
  }
  throw new Unsupported('takes a component that is not there');
}

/** The value with another number of components: one is repeated, of more the first are kept. */
export function convert(value: Expression, width: number): Expression {
  if (value.kind === 'constant')
    return {
      kind: 'constant',
      values: value.values.length === 1 ? spread(value.values, width) : value.values.slice(0, width),
    };
  if (value.kind !== 'texture' || value.width === width) return value;
  if (width === 1) return component(value, 0);
  if (value.width === 1) return { ...value, width };
  if (value.width < width) throw new Unsupported('has too few components');
  return {
    ...value,
    width,
    channels: value.channels === 'rgba' ? 'rgb' : value.channels,
    scale: spread(value.scale, value.width).slice(0, width),
    offset: spread(value.offset, value.width).slice(0, width),
  };
}

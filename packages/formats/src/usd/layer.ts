/** What an attribute holds: colours, vectors and matrices are flat arrays, as arrays of them are. */
export type UsdValue = number | string | boolean | ArrayLike<number> | readonly string[];

/** An attribute of a prim. */
export interface UsdAttribute {
  /** The type's name in USD, such as `color3f` or `int[]`. */
  readonly type: string;
  /** The default value, or that of the first time sample. */
  value?: UsdValue | undefined;
  /** Paths of the attributes that drive it. */
  connections?: readonly string[] | undefined;
  interpolation?: string | undefined;
}

/** A prim of one layer, as the layer says it: nothing is composed. */
export interface UsdPrim {
  readonly path: string;
  readonly name: string;
  /** `Mesh`, `Xform`, `Shader`, …; empty without one. */
  type: string;
  readonly children: UsdPrim[];
  readonly attributes: Map<string, UsdAttribute>;
  /** Targets by the relationship's name. */
  readonly relationships: Map<string, readonly string[]>;
  /** What composes other prims into it and is not followed: `references`, `payload`, `variantSets`, … */
  readonly arcs: Set<string>;
  /** Whether it defines something, which overrides and classes do not. */
  defined: boolean;
  /** Inactive prims do not exist for the scene. */
  active: boolean;
}

/** One layer: the content of a `.usda` or `.usdc` file. */
export interface UsdLayer {
  readonly root: UsdPrim;
  readonly upAxis?: string | undefined;
  readonly metersPerUnit?: number | undefined;
  readonly defaultPrim?: string | undefined;
  /** Other layers that it names beside it. */
  readonly subLayers: boolean;
}

/** Metadata of prims that compose other prims into them. */
export const ARCS = ['references', 'payload', 'inherits', 'specializes', 'variantSets', 'variantSetNames'];

/** A prim without content. */
export const emptyPrim = (path: string, name: string): UsdPrim => ({
  path,
  name,
  type: '',
  children: [],
  attributes: new Map(),
  relationships: new Map(),
  arcs: new Set(),
  defined: true,
  active: true,
});

/** The attribute's value if it is a number; of an array the first. */
export function numberOf(prim: UsdPrim, name: string): number | undefined {
  const value = prim.attributes.get(name)?.value;
  const first = typeof value === 'object' ? value[0] : typeof value === 'boolean' ? Number(value) : value;
  return typeof first === 'number' && Number.isFinite(first) ? first : undefined;
}

/** The attribute's value if it is a text. */
export function textOf(prim: UsdPrim, name: string): string | undefined {
  const value = prim.attributes.get(name)?.value;
  return typeof value === 'string' ? value : undefined;
}

/** The attribute's numbers; undefined for texts. */
export function numbersOf(prim: UsdPrim, name: string): ArrayLike<number> | undefined {
  const value = prim.attributes.get(name)?.value;
  if (typeof value === 'number') return [value];
  return typeof value === 'object' && typeof value[0] !== 'string' ? (value as ArrayLike<number>) : undefined;
}

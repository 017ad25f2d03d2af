import { fromRotationTranslationScale, invert, multiply } from 'gl-matrix/esm/mat4.js';
import { numbersOf, type UsdPrim } from './layer';

type Matrix = number[];

const STILL = [0, 0, 0];
const WHOLE = [1, 1, 1];
const UNTURNED = [0, 0, 0, 1];
const unit = (): Matrix => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** A turn about the axis x, y or z, in degrees. */
function turn(axis: number, degrees: number): Matrix {
  const half = (degrees * Math.PI) / 360;
  const quaternion = [0, 1, 2].map((k) => (k === axis ? Math.sin(half) : 0));
  return fromRotationTranslationScale(unit(), [...quaternion, Math.cos(half)], STILL, WHOLE);
}

/** The matrix of one operation; undefined if its value has another size. */
function operation(kind: string, values: ArrayLike<number>): Matrix | undefined {
  // Row-major matrices of row vectors lie in memory as column-major ones of column vectors.
  if (kind === 'transform') return values.length === 16 ? Array.from(values) : undefined;
  if (kind === 'orient') {
    const length = Math.hypot(...Array.from(values));
    if (values.length !== 4 || !(length > 0)) return undefined;
    const rotation = Array.from(values, (value) => value / length);
    return fromRotationTranslationScale(unit(), rotation, STILL, WHOLE);
  }
  const axes = /^rotate([XYZ]{1,3})$/.exec(kind)?.[1];
  if (values.length !== (axes?.length === 1 ? 1 : 3)) return undefined;
  if (kind === 'translate') return fromRotationTranslationScale(unit(), UNTURNED, values, WHOLE);
  if (kind === 'scale') return fromRotationTranslationScale(unit(), UNTURNED, STILL, values);
  if (axes === undefined) return undefined;
  // The first axis turns first; angles stand in the order x, y, z.
  const made = unit();
  for (const name of axes) {
    const axis = 'XYZ'.indexOf(name);
    multiply(made, turn(axis, values[axes.length === 1 ? 0 : axis] as number), made);
  }
  return made;
}

/**
 * A prim's transform by its `xformOpOrder` (UsdGeomXformable): column-major, to its parent; and whether it leaves out
 * the parent's. Operations without a value count as none.
 */
export function localTransform(prim: UsdPrim): { readonly matrix: Matrix; readonly resets: boolean } {
  const order = prim.attributes.get('xformOpOrder')?.value;
  let matrix = unit();
  let resets = false;
  if (typeof order !== 'object') return { matrix, resets };
  for (const name of Array.from(order as ArrayLike<number | string>, String)) {
    if (name === '!resetXformStack!') {
      matrix = unit();
      resets = true;
      continue;
    }
    const inverse = name.startsWith('!invert!');
    const own = inverse ? name.slice('!invert!'.length) : name;
    const values = numbersOf(prim, own);
    const made = values && operation(own.split(':')[1] ?? '', values);
    const used = made && inverse ? invert(unit(), made) : made;
    if (used) multiply(matrix, matrix, used);
  }
  return { matrix, resets };
}

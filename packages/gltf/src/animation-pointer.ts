// KHR_animation_pointer: an animation may move any number of the document, named by a JSON pointer. A scene is one moment, so
// the numbers of that moment are put into the document before anything is made of it.
import { valueAt } from './animation';
import type { Accessors } from './accessors';
import { isObject, type Raw } from './check/context';
import type { GltfAnimation } from './json';

/** A number (or numbers) of the document at a moment. */
export interface PointedValue {
  /** Parts of the JSON pointer, unescaped. */
  readonly path: readonly string[];
  readonly value: number | readonly number[] | boolean;
}

/** Where animations may reach: nothing in accessors or buffers can move, and extras are the host's. */
const ROOTS = /^\/(nodes|materials|cameras|meshes|extensions\/KHR_lights_punctual\/lights)\//;

/** The parts of a pointer to something that may move; undefined for others. */
export const pointerPath = (pointer: unknown): readonly string[] | undefined => (typeof pointer === 'string' && ROOTS.test(pointer) ? pointer.slice(1).split('/').map((part) => part.replaceAll('~1', '/').replaceAll('~0', '~')) : undefined);

/** What an animation's pointers say at a time. Values that are not finite do not count. */
export function pointedValues({ pointers, samplers }: GltfAnimation, time: number, accessors: Accessors): PointedValue[] {
  return (pointers ?? []).flatMap(({ sampler, path }) => {
    const { input, output, interpolation } = samplers[sampler] as (typeof samplers)[number];
    const name = path[path.length - 1] as string;
    const numbers = valueAt(accessors.floats(input), accessors.floats(output), interpolation, time, name === 'rotation' && accessors.at(output).type === 'VEC4');
    if (!numbers.every(Number.isFinite)) return [];
    const scalar = accessors.at(output).type === 'SCALAR' && numbers.length === 1 && name !== 'weights';
    return [{ path, value: name === 'visible' ? numbers[0] !== 0 : scalar ? (numbers[0] as number) : numbers }];
  });
}

/**
 * A document with other numbers in it; the given one stays as it is. What holds a number has to be there, the number need not
 * be: it then has a default.
 * @param warn Told of pointers that lead nowhere.
 */
export function withValues(json: Raw, values: readonly PointedValue[], warn: (path: string, what: string) => void): Raw {
  return values.reduce((document, { path, value }) => {
    const changed = replaced(document, path, value);
    if (changed === undefined) warn(`/${path.join('/')}`, 'is moved by an animation, but there is no such thing; nothing moves');
    return (changed as Raw | undefined) ?? document;
  }, json);
}

/** A copy with one value replaced; undefined if the way does not lead there, or to something else than such a value. */
function replaced(owner: unknown, [key, ...rest]: readonly string[], value: PointedValue['value']): unknown {
  if (key === undefined) return undefined;
  if (Array.isArray(owner)) {
    const index = /^(0|[1-9]\d{0,9})$/.test(key) ? Number(key) : -1;
    if (!(index >= 0 && index < owner.length)) return undefined;
    const entry = rest.length === 0 ? alike(owner[index], value) : replaced(owner[index], rest, value);
    return entry === undefined ? undefined : owner.map((old: unknown, at) => (at === index ? entry : old));
  }
  if (!isObject(owner) || key === '__proto__') return undefined;
  const entry = rest.length === 0 ? alike(Object.hasOwn(owner, key) ? owner[key] : undefined, value) : Object.hasOwn(owner, key) ? replaced(owner[key], rest, value) : undefined;
  return entry === undefined ? undefined : { ...owner, [key]: entry };
}

/** The value, if it is of the kind that stands there now, or nothing does. */
function alike(old: unknown, value: PointedValue['value']): PointedValue['value'] | undefined {
  if (old === undefined) return value;
  return typeof old === typeof value && Array.isArray(old) === Array.isArray(value) && (!Array.isArray(old) || !Array.isArray(value) || old.length === value.length) ? value : undefined;
}


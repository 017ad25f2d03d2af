// KHR_animation_pointer: an animation may animate any number of the document, named by a JSON pointer. A scene is a
// still, so the values at its time are written into the document before it is converted.
import { valueAt } from './animation';
import type { Accessors } from './accessors';
import type { Raw } from './json-value';
import type { GltfAnimation } from './json';

/** An animated value of the document at a time. */
export interface PointedValue {
  /** Parts of the JSON pointer, unescaped. */
  readonly path: readonly string[];
  readonly value: number | readonly number[] | boolean;
}

/** What can be animated: not accessors and buffers, nor extras, which belong to the host. */
const ROOTS = /^\/(nodes|materials|cameras|meshes|extensions\/KHR_lights_punctual\/lights)\//;

/** The parts of a pointer to a value that can be animated; undefined for others. */
export const pointerPath = (pointer: unknown): readonly string[] | undefined =>
  typeof pointer === 'string' && ROOTS.test(pointer)
    ? pointer
        .slice(1)
        .split('/')
        .map((part) => part.replaceAll('~1', '/').replaceAll('~0', '~'))
    : undefined;

/** The values of an animation's pointers at a time. Values that are not finite are ignored. */
export function pointedValues(
  { pointers, samplers }: GltfAnimation,
  time: number,
  accessors: Pick<Accessors, 'floats' | 'at'>,
): PointedValue[] {
  return (pointers ?? []).flatMap(({ sampler, path }) => {
    const { input, output, interpolation } = samplers[sampler] as (typeof samplers)[number];
    const name = path[path.length - 1] as string;
    const numbers = valueAt(
      accessors.floats(input),
      accessors.floats(output),
      interpolation,
      time,
      name === 'rotation' && accessors.at(output).type === 'VEC4',
    );
    if (!numbers.every(Number.isFinite)) return [];
    const scalar = accessors.at(output).type === 'SCALAR' && numbers.length === 1 && name !== 'weights';
    return [{ path, value: name === 'visible' ? numbers[0] !== 0 : scalar ? (numbers[0] as number) : numbers }];
  });
}

/**
 * A copy of a document with other values; the given one is not changed. The object that holds a value must exist; the
 * value itself need not, since it has a default.
 * @param warn Called for pointers to objects that do not exist.
 */
export function withValues(
  json: Raw,
  values: readonly PointedValue[],
  warn: (path: string, what: string) => void,
): Raw {
  // Each object on the path is copied once, however many values it holds.
  const copies = new Set<unknown>();
  const copyOf = <T extends object>(owner: T): T => {
    if (copies.has(owner)) return owner;
    const copy = (Array.isArray(owner) ? [...(owner as unknown[])] : { ...owner }) as T;
    copies.add(copy);
    return copy;
  };
  const document = copyOf(json) as Record<string, unknown>;
  for (const { path, value } of values) {
    let owner: Record<string, unknown> | unknown[] = document;
    let at = 0;
    for (; at < path.length - 1; at++) {
      const key = keyIn(owner, path[at] as string);
      const inside: unknown =
        key === undefined || !Object.hasOwn(owner, key) ? undefined : (owner as Record<string, unknown>)[key];
      if (key === undefined || typeof inside !== 'object' || inside === null) break;
      owner = (owner as Record<string, unknown>)[key] = copyOf(inside) as Record<string, unknown>;
    }
    const key = at === path.length - 1 ? keyIn(owner, path[at] as string) : undefined;
    const old = key !== undefined && Object.hasOwn(owner, key) ? (owner as Record<string, unknown>)[key] : undefined;
    if (key !== undefined && isAlike(old, value)) (owner as Record<string, unknown>)[key] = value;
    else warn(`/${path.join('/')}`, 'is moved by an animation, but there is no such thing; nothing moves');
  }
  return document;
}

/** A key that may be set: an index within an array, or a name that no prototype is reached by. */
function keyIn(owner: object, key: string): string | undefined {
  if (Array.isArray(owner)) return /^(0|[1-9]\d{0,9})$/.test(key) && Number(key) < owner.length ? key : undefined;
  return key === '__proto__' ? undefined : key;
}

/** Whether a value is of the kind that stands there now, or nothing does. */
const isAlike = (old: unknown, value: PointedValue['value']): boolean =>
  old === undefined ||
  (typeof old === typeof value &&
    Array.isArray(old) === Array.isArray(value) &&
    (!Array.isArray(old) || old.length === (value as readonly number[]).length));

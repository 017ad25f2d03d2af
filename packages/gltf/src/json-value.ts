/** An object of a document that has not been checked yet. */
export type Raw = { readonly [key: string]: unknown };

/** Whether a value is a JSON object. */
export const isObject = (value: unknown): value is Raw =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

/** Abbreviated JSON of a value; deep values would overflow the stack of JSON.stringify. */
export function brief(value: unknown, depth: number): string {
  if (typeof value === 'string') return JSON.stringify(value.slice(0, 60));
  if (typeof value === 'number') return String(value);
  if (typeof value !== 'object' || value === null) return JSON.stringify(value) ?? String(value);
  if (depth === 4) return '…';
  if (Array.isArray(value))
    return `[${value
      .slice(0, 20)
      .map((entry) => brief(entry, depth + 1))
      .join(',')}]`;
  return `{${Object.keys(value)
    .slice(0, 10)
    .map((key) => `${JSON.stringify(key.slice(0, 60))}:${brief((value as Raw)[key], depth + 1)}`)
    .join(',')}}`;
}

/** A value as quoted in a one-line message. */
export const quote = (value: unknown): string => {
  const text = value === undefined ? 'missing' : brief(value, 0);
  return text.length > 40 ? `${text.slice(0, 40)}…` : text;
};

/**
 * Whether objects and arrays are nested at most `maxDepth` deep. Values that are passed to the host must not overflow
 * its stack.
 */
export function isShallow(value: unknown, maxDepth = 100): boolean {
  let level: unknown[] = [value];
  for (let depth = 0; level.length > 0; depth++) {
    const inside = level.flatMap((entry): unknown[] =>
      typeof entry === 'object' && entry !== null ? Object.values(entry) : [],
    );
    if (inside.length > 0 && depth === maxDepth) return false;
    level = inside;
  }
  return true;
}

/** A property by its name; never one that all objects inherit, such as `constructor`. */
export const own = (object: Raw, key: string): unknown => (Object.hasOwn(object, key) ? object[key] : undefined);

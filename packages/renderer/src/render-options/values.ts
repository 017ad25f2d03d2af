import { RENDER_OPTIONS, type RenderOption, type RenderOptionName } from './table';

const isNumber = (value: unknown, [low, high]: readonly [number, number], integer: boolean, above = false): boolean =>
  typeof value === 'number' &&
  value >= low &&
  value <= high &&
  !(above && value === low) &&
  (!integer || Number.isInteger(value));

/** Whether an option takes a value. */
export function takesOption(name: RenderOptionName, value: unknown): boolean {
  const row: RenderOption = RENDER_OPTIONS[name];
  switch (row.type) {
    case 'boolean':
      return typeof value === 'boolean';
    case 'enum':
      return row.values.includes(value as string);
    case 'filter': {
      const { type, radius } = (typeof value === 'object' && value ? value : { type: value }) as Record<
        string,
        unknown
      >;
      return (
        typeof type === 'string' &&
        Object.hasOwn(row.radii, type) &&
        (radius === undefined || isNumber(radius, row.range, false, true))
      );
    }
    case 'limits':
      return (
        typeof value === 'object' &&
        value !== null &&
        Object.entries(value).every(
          ([kind, limit]) =>
            (row.kinds as readonly string[]).includes(kind) &&
            (limit === undefined || isNumber(limit, row.range, true)),
        )
      );
    default:
      return isNumber(value, row.range, row.type === 'integer', row.above);
  }
}

/** The values that an option takes, in words: `a whole number from 1 to 65535`. */
export function optionValues(name: RenderOptionName): string {
  const row: RenderOption = RENDER_OPTIONS[name];
  switch (row.type) {
    case 'boolean':
      return 'true or false';
    case 'enum':
      return `one of ${row.values.join(', ')}`;
    case 'filter':
      return `one of ${Object.keys(row.radii).join(', ')}, with a radius above 0 and at most ${row.range[1]} pixels`;
    case 'limits':
      return `whole numbers from ${row.range.join(' to ')} for some of ${row.kinds.join(', ')}`;
    default: {
      const [low, high] = row.range;
      return `a ${row.type === 'integer' ? 'whole ' : ''}number ${row.above ? `above ${low} and at most` : `from ${low} to`} ${high}`;
    }
  }
}

/** A value as error messages show it, in one line of at most about 40 characters. */
export const shownValue = (value: unknown): string =>
  typeof value === 'string'
    ? JSON.stringify(value.slice(0, 40))
    : typeof value === 'function' || (typeof value === 'object' && value !== null)
      ? `an ${Array.isArray(value) ? 'array' : 'object'}`
      : String(value);

/** Why an option does not take a value, as a sentence; `undefined` where it does. */
export const optionFault = (name: RenderOptionName, value: unknown): string | undefined =>
  takesOption(name, value) ? undefined : `${name} must be ${optionValues(name)}, not ${shownValue(value)}.`;

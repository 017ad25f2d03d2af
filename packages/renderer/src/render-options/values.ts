import { RENDER_OPTIONS, type RenderOptionName } from './table';

/** Any row, by its fields. */
interface Row {
  readonly type: string;
  readonly range?: readonly [number, number];
  readonly above?: boolean;
  readonly values?: readonly unknown[];
  readonly radii?: Readonly<Record<string, number>>;
}

const isObject = (value: unknown): value is object => Object(value) === value;

const isNumber = (value: unknown, { type, range: [low, high] = [0, 0], above }: Row): boolean =>
  typeof value === 'number' &&
  (above ? value > low : value >= low) &&
  value <= high &&
  (type === 'number' || Number.isInteger(value));

/** Whether an option takes a value. */
export function takesOption(name: RenderOptionName, value: unknown): boolean {
  const row: Row = RENDER_OPTIONS[name];
  const { type, values, radii } = row;
  if (type === 'boolean') return typeof value === type;
  if (type === 'limits')
    return (
      typeof value === 'object' &&
      isObject(value) &&
      Object.entries(value).every(
        ([kind, limit]) => values!.includes(kind) && (limit === undefined || isNumber(limit, row)),
      )
    );
  if (radii) {
    const { type: filter = value, radius = 1 } = Object(value);
    return typeof filter === 'string' && Object.hasOwn(radii, filter) && isNumber(radius, { ...row, type: 'number' });
  }
  if (type === 'names')
    return Array.isArray(value) && value.every((each, i) => values!.includes(each) && value.indexOf(each) === i);
  return values ? values.includes(value) : isNumber(value, row);
}

/** The values that an option takes, in words: `a whole number from 1 to 65535`. */
export function optionValues(name: RenderOptionName): string {
  const { type, range, above, values, radii }: Row = RENDER_OPTIONS[name];
  const number = range && `number ${above ? `above ${range[0]} and at most` : `from ${range[0]} to`} ${range[1]}`;
  if (radii) return `one of ${Object.keys(radii).join(', ')}, with a radius: a ${number}`;
  if (type === 'limits') return `a whole ${number} for each of ${values!.join(', ')}`;
  if (type === 'names') return `a list of names, each once, out of ${values!.join(', ')}`;
  if (values) return `one of ${values.join(', ')}`;
  return number ? `a ${type === 'integer' ? 'whole ' : ''}${number}` : 'true or false';
}

/** A value as error messages show it: in one line, and short. */
export const shownValue = (value: unknown): string =>
  typeof value === 'string' ? JSON.stringify(value.slice(0, 40)) : isObject(value) ? 'an object' : String(value);

/** Why an option does not take a value, as a sentence; `undefined` where it does. */
export const optionFault = (name: RenderOptionName, value: unknown): string | undefined =>
  takesOption(name, value) ? undefined : `${name} must be ${optionValues(name)}, not ${shownValue(value)}.`;

import { RENDER_OPTIONS, type RenderOptionName } from './table';

const numberOf = (text: string | undefined) => (text === undefined || text.trim() === '' ? NaN : Number(text));

/**
 * The value of an option that a text states, not yet validated (see {@link takesOption}): a number, a name, `true` or
 * `false`, `gaussian:2` for a filter with its radius, `diffuse=2,specular=4` for limits, `albedo,normal` for names.
 */
export function parseOption(name: RenderOptionName, text: string): unknown {
  const { type } = RENDER_OPTIONS[name];
  if (type === 'enum') return text;
  if (type === 'names') return text.split(',').map((part) => part.trim());
  if (type === 'boolean') return text === 'true' || (text === 'false' ? false : text);
  if (type === 'limits')
    return Object.fromEntries(
      text.split(',').map((part) => {
        const [kind = '', limit, ...more] = part.split('=');
        return [kind.trim(), more.length > 0 ? NaN : numberOf(limit)];
      }),
    );
  if (type !== 'filter') return numberOf(text);
  const at = text.indexOf(':');
  return at < 0 ? text : { type: text.slice(0, at), radius: numberOf(text.slice(at + 1)) };
}

/** The name of an option in kebab case, as in attributes and on the command line: `max-depth`. */
export const kebabCase = (name: string): string => name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);

/** The type of {@link kebabCase}'s result. */
export type KebabCase<Name extends string> = Name extends `${infer Head}${infer Tail}`
  ? `${Head extends Lowercase<Head> ? Head : `-${Lowercase<Head>}`}${KebabCase<Tail>}`
  : Name;

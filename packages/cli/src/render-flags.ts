import {
  kebabCase,
  MAX_ADAPTIVE_SAMPLES,
  optionValues,
  parseOption,
  RENDER_OPTION_TEXTS,
  RENDER_OPTIONS,
  takesOption,
  type BooleanOption,
  type EnumOption,
  type FilterOption,
  type KebabCase,
  type LimitsOption,
  type NumberOption,
  type RenderOption,
  type RenderOptionName,
  type ResolvedSettings,
} from '@glanz/renderer/options';
import { CliError } from './errors';

/**
 * The command line renders for no screen: its submissions have a length of their own. Which layers it needs follows from
 * its outputs.
 */
type Excluded = 'maxSubmitMs' | 'aovs';
const EXCLUDED: readonly RenderOptionName[] = ['maxSubmitMs', 'aovs'] satisfies readonly Excluded[];

type FlagName = Exclude<RenderOptionName, Excluded>;
type FlagOf<Name extends FlagName> = (typeof RENDER_OPTIONS)[Name] extends BooleanOption
  ? `no-${KebabCase<Name>}`
  : KebabCase<Name>;

/** The options of the table that the command line has, in its order. */
export const FLAG_OPTIONS = (Object.keys(RENDER_OPTIONS) as RenderOptionName[]).filter(
  (name) => !EXCLUDED.includes(name),
) as FlagName[];

const isBoolean = (name: RenderOptionName) => RENDER_OPTIONS[name].type === 'boolean';

/** An option's name on the command line, without dashes: `max-depth`; `no-caustics`, since booleans are on by default. */
export const flagOf = (name: FlagName): string => `${isBoolean(name) ? 'no-' : ''}${kebabCase(name)}`;

/** What `parseArgs` needs to know of the options of the table. */
export const RENDER_FLAGS = Object.fromEntries(
  FLAG_OPTIONS.map((name) => [flagOf(name), { type: isBoolean(name) ? 'boolean' : 'string' }]),
) as {
  readonly [Name in FlagName as FlagOf<Name>]: {
    readonly type: (typeof RENDER_OPTIONS)[Name] extends BooleanOption ? 'boolean' : 'string';
  };
};

/** Settings of an image: all that have a default, and the others where the command line gives them. */
export type FlagSettings = Omit<ResolvedSettings, Excluded>;

const EXAMPLES: Partial<Record<FlagName, string>> = {
  filter: 'gaussian or gaussian:2',
  maxBounces: 'diffuse=2,specular=4',
  memory: 'budgetMiB=512',
};

/**
 * The settings that flags give, by the names of the flags, with the defaults of the others.
 * @throws {CliError} `cli/usage`
 */
export function settingsOf(values: Readonly<Record<string, unknown>>): FlagSettings {
  const settings: Record<string, unknown> = {};
  for (const name of FLAG_OPTIONS) {
    const [flag, row]: [string, RenderOption] = [flagOf(name), RENDER_OPTIONS[name]];
    const given = values[flag];
    if (given === undefined) {
      if (row.default !== undefined) settings[name] = row.default;
      continue;
    }
    const value = row.type === 'boolean' ? !given : parseOption(name, given as string);
    if (!takesOption(name, value))
      throw new CliError(
        'cli/usage',
        `--${flag} must be ${optionValues(name)}${EXAMPLES[name] ? `, such as ${EXAMPLES[name]}` : ''}, not "${String(given)}".`,
      );
    settings[name] = value;
  }
  if (settings['noise'] === 0) delete settings['noise'];
  if (settings['noise'] !== undefined && values['samples'] === undefined) settings['samples'] = MAX_ADAPTIVE_SAMPLES;
  return settings as unknown as FlagSettings;
}

const PLACEHOLDERS: Readonly<Record<RenderOption['type'], string>> = {
  number: 'F',
  integer: 'N',
  boolean: '',
  enum: 'NAME',
  filter: 'NAME',
  limits: 'LIST',
  names: 'LIST',
};

const COLUMN = 24;
const WIDTH = 80;

/** Words in lines from a column on. */
function wrapped(text: string): string[] {
  const lines: string[] = [];
  for (const word of text.split(' ')) {
    const last = lines.at(-1);
    if (last !== undefined && COLUMN + last.length + 1 + word.length <= WIDTH) lines[lines.length - 1] += ` ${word}`;
    else lines.push(word);
  }
  return lines;
}

/** The values and the default of an option, in brackets; booleans have none. */
function valuesText(name: FlagName): string {
  const row: RenderOption = RENDER_OPTIONS[name];
  const named = (value: string) => (value === row.default ? `${value} (default)` : value);
  const texts: Record<RenderOption['type'], () => string> = {
    boolean: () => '',
    enum: () => (row as EnumOption).values.map(named).join(', '),
    filter: () =>
      `${Object.keys((row as FilterOption).radii)
        .map(named)
        .join(', ')}; NAME:RADIUS in pixels`,
    limits: () => `${(row as LimitsOption).values.join(', ')}: ${EXAMPLES[name]}`,
    names: () => '',
    number: () => rangeText(row as NumberOption),
    integer: () => rangeText(row as NumberOption),
  };
  const text = texts[row.type]();
  return text && ` [${text}]`;
}

const rangeText = ({ range: [low, high], above, default: initial }: NumberOption) =>
  `${above ? `above ${low}, to` : `${low} to`} ${high}${initial === undefined ? '' : `; default ${initial}`}`;

/** The lines of the manual about the biased options of the table, or about the others. */
export function flagsHelp({ biased }: { readonly biased: boolean }): string {
  return FLAG_OPTIONS.filter((name) => (RENDER_OPTION_TEXTS[name].biased ?? false) === biased)
    .map((name) => {
      const { type } = RENDER_OPTIONS[name];
      const { doc } = RENDER_OPTION_TEXTS[name];
      const text = type === 'boolean' ? `Turn off: ${doc.charAt(0).toLowerCase()}${doc.slice(1)}` : doc;
      const lines = wrapped(`${text.replaceAll('`', '')}${valuesText(name)}`);
      const head = `      --${flagOf(name)} ${PLACEHOLDERS[type]}`.trimEnd();
      const first = head.length < COLUMN - 1 ? `${head.padEnd(COLUMN - 1)} ${lines.shift()}` : head;
      return [first, ...lines.map((line) => ' '.repeat(COLUMN) + line)].join('\n');
    })
    .join('\n');
}

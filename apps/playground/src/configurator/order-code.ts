import { applies, choicesOf, FEATURES, usual, type Configuration, type FeatureName } from './catalogue';

const PREFIX = 'GB22';

/** Features whose letters stand together in the code. */
const GROUPS: readonly (readonly FeatureName[])[] = [
  ['shape', 'colour'],
  ['legend'],
  ['bezel', 'finish'],
  ['light'],
  ['mounting', 'panel'],
  ['contacts'],
];

/** Stands for a feature that does not apply. */
const NOTHING = '0';

/** The order code of a button, e.g. `GB22-FG-P-RC-G-PA-C`. */
export function orderCode(configuration: Configuration): string {
  return [
    PREFIX,
    ...GROUPS.map((group) =>
      group.map((feature) => (applies(configuration, feature) ? configuration[feature] : NOTHING)).join(''),
    ),
  ].join('-');
}

/** The button of an order code, whatever its case and spaces; undefined where it is none. */
export function parseOrderCode(text: string): Configuration | undefined {
  const match = /^#?\s*(\w+)-([\w-]+)\s*$/.exec(text);
  if (!match || match[1]?.toUpperCase() !== PREFIX) return undefined;
  const groups = (match[2] ?? '').toUpperCase().split('-');
  if (groups.length !== GROUPS.length || groups.some((group, i) => group.length !== GROUPS[i]?.length))
    return undefined;
  const letters = groups.join('');
  const order = GROUPS.flat();
  const given = Object.fromEntries(order.map((feature, i) => [feature, letters[i] ?? ''])) as Configuration;
  // A button without a panel has no finish of it: the usual one is kept for the day it gets one.
  const configuration = given.panel === NOTHING && given.mounting === 'N' ? { ...given, panel: usual().panel } : given;
  return FEATURES.every((feature) => choicesOf(feature).some(({ code }) => code === configuration[feature]))
    ? configuration
    : undefined;
}

import { BenchError } from './error';

/**
 * A number that the command line gives to a benchmark.
 *
 * @throws {BenchError} `bench/option` for what is no number above 0, or no whole one.
 */
export function numberOption(
  values: Readonly<Record<string, string | undefined>>,
  name: string,
  standard: number,
  whole = true,
): number {
  const text = values[name];
  const value = text === undefined ? standard : Number(text);
  if (!(value > 0) || (whole && !Number.isInteger(value)))
    throw new BenchError('bench/option', `--${name} must be a ${whole ? 'whole ' : ''}number above 0, not "${text}".`);
  return value;
}

/**
 * Names separated by commas, in the order of `all`; all of them where nothing is given.
 *
 * @throws {BenchError} `bench/option` for a name that is not among them.
 */
export function listOption<T extends string>(text: string | undefined, all: readonly T[], what: string): readonly T[] {
  if (text === undefined) return all;
  const requested = text.split(',');
  const unknown = requested.find((name) => !(all as readonly string[]).includes(name));
  if (unknown !== undefined)
    throw new BenchError('bench/option', `There is no ${what} "${unknown}"; there are: ${all.join(', ')}.`);
  return all.filter((name) => requested.includes(name));
}

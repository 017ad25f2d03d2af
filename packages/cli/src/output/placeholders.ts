import { CliError } from '../errors';

export const PLACEHOLDER = /\{(\w+)\}/g;

export const NAMES = ['model', 'variant', 'view'];

/** Whether a path has places for names. */
export const hasPlaceholders = (path: string): boolean => path.search(PLACEHOLDER) >= 0;

/** @throws {CliError} `cli/usage` for a place that nothing is known for. */
export function checkPlaceholders(path: string, option = '--output'): void {
  for (const [whole, name] of path.matchAll(PLACEHOLDER))
    if (!NAMES.includes(name as string))
      throw new CliError(
        'cli/usage',
        `${option} "${path}": ${whole} is unknown. Known: ${NAMES.map((known) => `{${known}}`).join(', ')}.`,
      );
}

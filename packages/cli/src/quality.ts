import type { PathTracerOptions } from '@glanz/renderer';
import { CliError } from './errors';

/** What the command line passes on to the tracer as it is. Empty: the tracer's defaults. */
export type QualityOptions = Pick<
  PathTracerOptions,
  'filter' | 'lightGroups' | 'clampIndirect' | 'regularization' | 'caustics' | 'maxBounces' | 'backFaceCulling'
>;

const FILTERS = ['box', 'gaussian', 'blackman-harris'] as const;

const GROUPS = ['off', 'named', 'each'] as const;

/** `--light-groups MODE`. @throws {CliError} `cli/usage` */
export function parseLightGroups(text: string): (typeof GROUPS)[number] {
  const mode = GROUPS.find((known) => known === text);
  if (!mode) throw new CliError('cli/usage', `--light-groups must be one of ${GROUPS.join(', ')}, not "${text}".`);
  return mode;
}

const CULLING = ['off', 'camera', 'all'] as const;

/** `--back-face-culling MODE`. @throws {CliError} `cli/usage` */
export function parseCulling(text: string): (typeof CULLING)[number] {
  const mode = CULLING.find((known) => known === text);
  if (!mode)
    throw new CliError('cli/usage', `--back-face-culling must be one of ${CULLING.join(', ')}, not "${text}".`);
  return mode;
}

const KINDS = ['diffuse', 'specular', 'transmission', 'volume'] as const;

/** `--max-bounces diffuse=2,specular=4`. @throws {CliError} `cli/usage` */
export function parseBounces(text: string): NonNullable<PathTracerOptions['maxBounces']> {
  return Object.fromEntries(
    text.split(',').map((part) => {
      const [, name, count] = /^\s*(\w+)\s*=\s*(\d+)\s*$/.exec(part) ?? [];
      const kind = KINDS.find((known) => known === name);
      if (!kind)
        throw new CliError(
          'cli/usage',
          `--max-bounces must be like diffuse=2,specular=4 with ${KINDS.join(', ')}, not "${text}".`,
        );
      return [kind, Number(count)];
    }),
  );
}

/** `--filter NAME` or `NAME:RADIUS`. @throws {CliError} `cli/usage` */
export function parseFilter(text: string): NonNullable<PathTracerOptions['filter']> {
  const [name, radius] = text.split(':') as [string, string?];
  const type = FILTERS.find((known) => known === name);
  if (!type) throw new CliError('cli/usage', `There is no pixel filter "${name}". Known: ${FILTERS.join(', ')}.`);
  if (radius === undefined) return type;
  const pixels = radius.trim() === '' ? NaN : Number(radius);
  if (!(pixels > 0 && pixels <= 16))
    throw new CliError(
      'cli/usage',
      `--filter ${type}:RADIUS must be a number above 0 up to 16, in pixels, not "${radius}".`,
    );
  return { type, radius: pixels };
}

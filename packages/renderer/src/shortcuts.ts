import { RenderError } from './errors';
import type { PathTracerOptions } from './options';

const KINDS = ['diffuse', 'specular', 'transmission', 'volume'] as const;

/** A byte counts each kind of bounce, to 127; a limit above is never reached. */
const MOST = 127;

/**
 * Checks the options that trade truth for time.
 * @throws {RenderError} `renderer/option`
 */
export function checkShortcuts({ clampIndirect, regularization, maxBounces }: PathTracerOptions): void {
  const fail = (message: string) => {
    throw new RenderError('renderer/option', message);
  };
  if (clampIndirect !== undefined && !(clampIndirect > 0))
    fail(`clampIndirect must be above 0, not ${clampIndirect}; leave it out to clamp nothing.`);
  if (regularization !== undefined && !(regularization >= 0 && regularization <= 1))
    fail(`regularization must lie between 0 and 1, not ${regularization}.`);
  for (const kind of KINDS) {
    const limit = maxBounces?.[kind];
    if (limit !== undefined && !(Number.isInteger(limit) && limit >= 0))
      fail(`maxBounces.${kind} must be a whole number of at least 0, not ${limit}.`);
  }
}

/** What the options that trade truth for time say about the kernels' text. */
export function shortcutFlags({
  clampIndirect,
  regularization,
  caustics,
  maxBounces,
}: PathTracerOptions): Readonly<Record<string, boolean>> {
  const REGULARIZE = (regularization ?? 0) > 0;
  const NO_CAUSTICS = caustics === false;
  const BOUNCE_LIMITS = KINDS.some((kind) => maxBounces?.[kind] !== undefined);
  return {
    CLAMP_INDIRECT: clampIndirect !== undefined && clampIndirect < Infinity,
    REGULARIZE,
    NO_CAUSTICS,
    BOUNCE_LIMITS,
    PATH_STATE: REGULARIZE || NO_CAUSTICS || BOUNCE_LIMITS,
  };
}

/** Their part of the frame uniforms. */
export function shortcutUniforms({ clampIndirect, regularization, maxBounces }: PathTracerOptions): {
  clamp_indirect: number;
  regularization: number;
  bounce_limits: number[];
} {
  return {
    clamp_indirect: Math.min(clampIndirect ?? 3e38, 3e38),
    regularization: regularization ?? 0,
    bounce_limits: KINDS.map((kind) => Math.min(maxBounces?.[kind] ?? MOST + 1, MOST + 1)),
  };
}

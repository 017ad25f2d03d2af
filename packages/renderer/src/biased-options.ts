import type { TracerSettings } from './option-checks';
import { RENDER_OPTIONS } from './render-options';

type BiasedOptions = Pick<TracerSettings, 'clampIndirect' | 'regularization' | 'caustics' | 'maxBounces'>;

const KINDS = RENDER_OPTIONS.maxBounces.values;

/** A byte counts the bounces of each kind, up to 127; a higher limit is never reached. */
const MAX_COUNT = 127;

/** The kernels' flags that the biased options decide. */
export function biasedFlags({
  clampIndirect,
  regularization,
  caustics,
  maxBounces,
}: BiasedOptions): Readonly<Record<string, boolean>> {
  const REGULARIZE = regularization > 0;
  const NO_CAUSTICS = !caustics;
  const BOUNCE_LIMITS = KINDS.some((kind) => maxBounces?.[kind] !== undefined);
  return {
    CLAMP_INDIRECT: clampIndirect !== undefined,
    REGULARIZE,
    NO_CAUSTICS,
    BOUNCE_LIMITS,
    PATH_STATE: REGULARIZE || NO_CAUSTICS || BOUNCE_LIMITS,
  };
}

/** The frame uniforms of the biased options. */
export function biasedUniforms({ clampIndirect = 3e38, regularization, maxBounces }: BiasedOptions): {
  clamp_indirect: number;
  regularization: number;
  bounce_limits: number[];
} {
  return {
    clamp_indirect: clampIndirect,
    regularization,
    bounce_limits: KINDS.map((kind) => Math.min(maxBounces?.[kind] ?? MAX_COUNT + 1, MAX_COUNT + 1)),
  };
}

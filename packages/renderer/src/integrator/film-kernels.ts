import aov from '../film/aov.wesl';
import aovIds from '../film/aov_ids.wesl';
import noise from '../film/noise.wesl';
import relight from '../film/relight.wesl';
import variance from '../film/variance_layer.wesl';

/** Entry points of the kernels that work on a film's sums and AOVs. Loaded when one is first needed. */
export const FILM_KERNELS = { aov, aov_ids: aovIds, noise, relight, variance } as const;

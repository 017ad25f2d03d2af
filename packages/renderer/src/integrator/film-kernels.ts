import noise from '../film/noise.wesl';
import relight from '../film/relight.wesl';
import variance from '../film/variance_layer.wesl';

/** Entry points of the kernels that work on a film's sums. Loaded when one is first needed. */
export const FILM_KERNELS = { noise, relight, variance } as const;

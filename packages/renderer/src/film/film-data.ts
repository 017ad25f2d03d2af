import noise from './noise.wesl';
import relight from './relight.wesl';
import variance from './variance_layer.wesl';

/** What is made of a film's data after the first image. Loaded when it is first needed. */
export { filmStateFault } from './film-check';
export { groupLayer, unpackAov, varianceLayer } from './layers';

/** Entry points of the kernels that work on a film's sums. */
export const FILM_KERNELS = { noise, relight, variance } as const;

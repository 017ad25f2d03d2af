/** What is computed of a film's data on the CPU. Loaded when it is first needed, after the first image. */
export { filmStateFault } from './film-check';
export { groupLayer, unpackAov, varianceLayer } from './layers';

/** What is made of a film's data after the first image. Loaded when it is first needed. */
export { filmStateFault } from './film-check';
export { groupLayer, unpackAov, varianceLayer } from './layers';

export { fromThree, type FromThreeOptions } from './from-three';
export { ThreePathTracer, type ThreeChanges, type ThreePathTracerOptions } from './three-path-tracer';
export type { ThreeCamera, ThreeObject } from './types';
export { ThreeError } from './error';

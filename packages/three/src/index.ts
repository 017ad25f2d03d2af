export { fromThree, type FromThreeOptions } from './from-three';
export type { ThreeCamera, ThreeObject } from './types';
export { ThreeError } from './error';

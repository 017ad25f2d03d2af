export { shapesFrom, tuneShapes, type TuneOptions, type TunedShapes } from './tune-shapes';

export {
  GroundTruth,
  catalogueFolder,
  type ReferencePicture,
  type SceneDescription,
  type Tolerance,
} from './catalogue';
export { comparePictures, failures, relMse, type Check, type Comparison } from './compare';
export { ReferenceError } from './error';
export {
  FURNACE_MATERIALS,
  furnaceScene,
  icosphere,
  measureFurnace,
  type FurnaceMaterial,
  type FurnaceMeasurement,
  type FurnaceOptions,
} from './furnace';
export { renderGroundTruth, renderPicture, type GroundTruthOptions } from './render';
export { GROUND_TRUTH_CASES, type GroundTruthCase } from './cases';
export { convergenceSlope, measureConvergence, type ConvergencePoint } from './slope';

export {
  GroundTruth,
  referenceFolder,
  type ReferenceImage,
  type SceneDescription,
  type Tolerance,
} from './reference-set';
export { compareImages, failures, relMse, type Check, type Comparison } from './compare';
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
export { renderGroundTruth, renderImage, type GroundTruthOptions } from './render';
export { GROUND_TRUTH_CASES, type GroundTruthCase } from './cases';
export { convergenceSlope, measureConvergence, type ConvergencePoint } from './slope';
export { estimate, type Estimate, type EstimateOptions } from './estimator/estimate';
export { compareEstimates, type Agreement } from './estimator/agreement';
export { GLASS_SCENES, glassScene, type GlassScene, type GlassSceneName } from './estimator/glass-scenes';
export { readGlassReference, type GlassReferenceInfo } from './estimator/glass-reference';
export { renderGlass } from './estimator/render-glass';

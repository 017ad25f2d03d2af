export { droppableBlocks, reduceImageSteps } from './reduce-image';
export { inSlices, type SliceOptions, type Steps } from './slices';
export {
  levelSize,
  mebibytes,
  planTextureLevels,
  textureBytes,
  visibleLoss,
  type TextureCost,
  type TextureLevels,
} from './texture-levels';

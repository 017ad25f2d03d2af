export { droppableBlocks, reduceImageSteps } from './reduce-image';
export {
  levelSize,
  mebibytes,
  planTextureLevels,
  textureBytes,
  visibleLoss,
  type TextureCost,
  type TextureLevels,
} from './texture-levels';

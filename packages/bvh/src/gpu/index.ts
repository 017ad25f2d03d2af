export { GpuBuilder } from './builder';
export { blasInOrder } from './in-order';
export { gpuBuildMemory } from './plan';
export { readGpuBlas, readGpuBoxTree } from './read';
export { GpuRefitter, type PreparedRefit, type RefitBlas } from './refit';
export type {
  GpuBlas,
  GpuBlasOptions,
  GpuBoxes,
  GpuBoxTree,
  GpuBuildOptions,
  GpuBuildTimes,
  GpuMesh,
  GpuTree,
} from './options';

export { GpuBuilder } from './builder';
export { gpuBuildMemory } from './plan';
export { readGpuBlas } from './read';
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

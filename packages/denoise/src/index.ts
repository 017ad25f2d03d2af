export { Denoiser } from './denoiser';
export { DenoiseError } from './error';
export { parseTza, type TzaTensor } from './tza';
export type {
  DenoiseImages,
  DenoiseKernels,
  DenoiseOptions,
  DenoiseResult,
  DenoiserInput,
  DenoiserOptions,
  DenoiserPrepareOptions,
  DenoiserStorage,
  ImageBuffer,
  LayerSize,
} from './options';
export type { KernelFamily } from './kernels/shapes';

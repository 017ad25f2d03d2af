export { DenoiseError } from './error';
export { parseTza, type TzaTensor } from './tza';
export type {
  DenoiseImages,
  DenoiseOptions,
  DenoiserInput,
  DenoiserOptions,
  DenoiserStorage,
  ImageBuffer,
} from './options';

export { DeviceError, RenderError } from './errors';
export { requestDevice, type DeviceOptions } from './device/device';
export type { FilmPart, FilmState } from './film/film-state';
export { isSoftware } from './device/software';
export { compressedFormats } from './materials/textures';
export { PathTracer } from './path-tracer';
export type {
  AovName,
  BackFaceCulling,
  BounceLimits,
  FilmAov,
  FilmLayer,
  HierarchyBuild,
  HierarchyBuilder,
  HistoryFrame,
  LightGroup,
  LightGroupMode,
  PathTracerOptions,
  PickResult,
  PixelFilter,
  PrepareProgress,
  FirstLight,
  RenderOptions,
  RenderProgress,
  RenderStatistics,
  Sampler,
  TracerDenoiser,
} from './options';
export type { MemoryBudget, MemoryReport, ReducedTexture } from './memory';
export { warmUp, type WarmUpOptions } from './warm-up';
export { CostModel } from './schedule/cost-model';

export { DeviceError, RenderError } from './errors';
export { requestDevice, type DeviceOptions } from './gpu/device';
export { decodeFilmState, encodeFilmState, type FilmState } from './film/film-state';
export { isSoftware } from './software';
export { compressedFormats } from './scene/textures';
export { PathTracer } from './path-tracer';
export type {
  BackFaceCulling,
  BounceLimits,
  FilmLayer,
  HierarchyBuilder,
  LightGroup,
  LightGroupMode,
  MemoryReport,
  PathTracerOptions,
  PickResult,
  PixelFilter,
  PrepareProgress,
  FirstLight,
  RenderOptions,
  RenderProgress,
  RenderStatistics,
  Sampler,
} from './options';
export { warmUp, type WarmUpOptions } from './warm-up';

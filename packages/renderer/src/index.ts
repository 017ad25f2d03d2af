export { DeviceError, RenderError } from './errors';
export { requestDevice, type DeviceOptions } from './gpu/device';
export { PathTracer } from './path-tracer';
export type { FilmLayer, HierarchyBuilder, LightGroup, LightGroupMode, PathTracerOptions, PickResult, PixelFilter, PrepareProgress, RenderOptions, RenderProgress, RenderStatistics } from './options';

export { runCli } from './run';
export { nodeIo, type CliIo, type Interrupt } from './io';
export {
  nodeBackend,
  type Backend,
  type FilmCodec,
  type FilmState,
  type ListedGpu,
  type OpenedGpu,
  type Tracer,
} from './backend';
export { CliError, EXIT, exitCodeOf } from './errors';
export type { BatchResult, FailedImage, RenderResult, RenderTimings } from './render/results';
export type { WrittenFile } from './output/write';

export { createGpu, listGpus, type GpuOptions, type NodeGpu } from './node/create-gpu';
export type { GpuDescription } from './node/adapter-info';
export { DeviceError } from './errors';

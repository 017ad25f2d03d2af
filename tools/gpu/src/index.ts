export { expectNoGpuErrors, testDevice, type TestDeviceOptions } from './device';
export { runCompute, type ComputeInput, type ComputeOptions } from './run-compute';

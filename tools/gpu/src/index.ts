export { expectNoGpuErrors, testDevice, type TestDeviceOptions } from './device';
export { nullDevice } from './null-device';
export { runCompute, type ComputeInput, type ComputeOptions } from './run-compute';

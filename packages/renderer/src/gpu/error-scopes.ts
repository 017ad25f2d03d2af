import { DeviceError } from '../errors';

/**
 * Runs an upload inside error scopes, so that what the GPU refuses becomes an error here.
 * @throws {DeviceError} `renderer/out-of-memory`, `renderer/gpu-error`, and what `run` throws
 */
export async function withErrorScopes<T>(device: GPUDevice, run: () => T): Promise<T> {
  device.pushErrorScope('out-of-memory');
  device.pushErrorScope('validation');
  const caught = () => Promise.all([device.popErrorScope(), device.popErrorScope()]);
  let result: T;
  try {
    result = run();
  } catch (error) {
    await caught();
    throw error;
  }
  const [validation, memory] = await caught();
  if (memory) throw new DeviceError('renderer/out-of-memory', `The GPU has not enough memory for this scene: ${memory.message}`);
  if (validation) throw new DeviceError('renderer/gpu-error', `The GPU refused the scene: ${validation.message}`);
  return result;
}

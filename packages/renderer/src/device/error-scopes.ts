import { DeviceError, deviceLost } from '../errors';
import { lossInfo, onDeviceLost } from './device-loss';

/** Milliseconds to wait for a device's loss to be reported, once something has failed that a loss makes fail. */
const LOSS_MS = 100;

/** What ran inside error scopes. */
export interface Scoped<T> {
  readonly result: T;
  /**
   * Settles when the GPU has checked all calls. Rejects with `renderer/out-of-memory` or `renderer/gpu-error`; never
   * unhandled.
   */
  readonly verified: Promise<void>;
}

/**
 * Runs calls to the GPU inside error scopes, so that errors are reported here and not to the host's `uncapturederror`
 * listeners.
 *
 * @param what Completes "The GPU does not have enough memory for …".
 * @throws What `run` throws; the errors of the GPU are those of {@link Scoped.verified}.
 */
export function inErrorScopes<T>(device: GPUDevice, what: string, run: () => T): Scoped<T> {
  device.pushErrorScope('internal');
  device.pushErrorScope('out-of-memory');
  device.pushErrorScope('validation');
  let result: T;
  let verified: Promise<void>;
  try {
    result = run();
  } finally {
    verified = checkScopes(what, [device.popErrorScope(), device.popErrorScope(), device.popErrorScope()], device);
    verified.catch(() => {});
  }
  return { result, verified };
}

async function checkScopes(
  what: string,
  scopes: readonly Promise<GPUError | null>[],
  device: GPUDevice,
): Promise<void> {
  const [validation, memory, internal] = await Promise.all(scopes).catch(async (cause: unknown) => {
    throw await lossOr(
      device,
      new DeviceError('renderer/gpu-error', `The GPU failed at ${what}: ${(cause as Error).message}`, { cause }),
    );
  });
  // What has no memory is invalid, and using it a validation error: the first cause counts.
  if (memory) {
    throw new DeviceError(
      'renderer/out-of-memory',
      `The GPU does not have enough memory for ${what}: ${memory.message || 'no details'}. Make the image, textures or meshes smaller.`,
    );
  }
  const refused = validation ?? internal;
  if (refused)
    throw new DeviceError('renderer/gpu-error', `The GPU refused ${what}: ${refused.message || 'no details'}`);
}

/**
 * As {@link inErrorScopes}, once the GPU has checked it.
 * @throws {DeviceError} `renderer/out-of-memory`, `renderer/gpu-error`, and what `run` throws
 */
export async function withErrorScopes<T>(device: GPUDevice, what: string, run: () => T): Promise<T> {
  const { result, verified } = inErrorScopes(device, what, run);
  await verified;
  return result;
}

/** The error of a device that is lost, or else `error`. A loss may be reported a moment after what it makes fail. */
export async function lossOr(device: GPUDevice, error: DeviceError): Promise<DeviceError> {
  if (!lossInfo(device)) {
    let stop = () => {};
    await new Promise<void>((resolve) => {
      const timer = setTimeout(resolve, LOSS_MS);
      const ignore = onDeviceLost(device, () => resolve());
      stop = () => (clearTimeout(timer), ignore());
    });
    stop();
  }
  const info = lossInfo(device);
  return info ? deviceLost(info) : error;
}

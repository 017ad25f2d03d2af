import { DeviceError } from '../errors';
import { GPU_BUFFER_COPY_DST, GPU_BUFFER_MAP_READ } from './buffers';
import { inErrorScopes, lossOr } from '../device/error-scopes';

/**
 * Copies a GPU buffer to the CPU. The copy is submitted before this returns.
 *
 * @throws {DeviceError} `renderer/device-lost` if the device went away meanwhile, `renderer/out-of-memory` if there is
 * no room for the copy, `renderer/gpu-error` if the GPU refuses it.
 */
export async function readBuffer(
  device: GPUDevice,
  source: GPUBuffer,
  bytes: number,
  offset = 0,
): Promise<ArrayBuffer> {
  let staging: GPUBuffer | undefined;
  try {
    const { result: mapping, verified } = inErrorScopes(device, 'reading back from it', () => {
      staging = device.createBuffer({
        label: 'glanz read',
        size: bytes,
        usage: GPU_BUFFER_MAP_READ | GPU_BUFFER_COPY_DST,
      });
      const encoder = device.createCommandEncoder({ label: 'glanz read' });
      encoder.copyBufferToBuffer(source, offset, staging, 0, bytes);
      device.queue.submit([encoder.finish()]);
      return staging.mapAsync(1);
    });
    const [mapped] = await Promise.allSettled([mapping]);
    await verified;
    if (mapped.status === 'rejected') throw mapped.reason;
    return (staging as GPUBuffer).getMappedRange().slice(0);
  } catch (cause) {
    if (cause instanceof DeviceError && cause.code === 'renderer/out-of-memory') throw cause;
    throw await lossOr(
      device,
      cause instanceof DeviceError
        ? cause
        : new DeviceError('renderer/gpu-error', `Reading back from the GPU failed: ${(cause as Error).message}`, {
            cause,
          }),
    );
  } finally {
    staging?.destroy();
  }
}

/** The same as numbers; by default the whole buffer. */
export async function readFloats(
  device: GPUDevice,
  source: GPUBuffer,
  bytes = source.size,
): Promise<Float32Array<ArrayBuffer>> {
  return new Float32Array(await readBuffer(device, source, bytes));
}

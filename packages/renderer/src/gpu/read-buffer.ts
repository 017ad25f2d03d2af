import { DeviceError } from '../errors';
import { GPU_BUFFER_COPY_DST, GPU_BUFFER_MAP_READ } from './buffers';

/**
 * Copies a GPU buffer to the CPU.
 * @throws {DeviceError} `renderer/device-lost` if the device went away meanwhile.
 */
export async function readBuffer(device: GPUDevice, source: GPUBuffer, bytes: number, offset = 0): Promise<ArrayBuffer> {
  const staging = device.createBuffer({ label: 'glanz read', size: bytes, usage: GPU_BUFFER_MAP_READ | GPU_BUFFER_COPY_DST });
  try {
    const encoder = device.createCommandEncoder({ label: 'glanz read' });
    encoder.copyBufferToBuffer(source, offset, staging, 0, bytes);
    device.queue.submit([encoder.finish()]);
    await staging.mapAsync(1);
    return staging.getMappedRange().slice(0);
  } catch (cause) {
    throw new DeviceError('renderer/device-lost', `Reading back from the GPU failed: ${(cause as Error).message}`, { cause });
  } finally {
    staging.destroy();
  }
}

/** The same as numbers; the whole buffer, unless told otherwise. */
export async function readFloats(device: GPUDevice, source: GPUBuffer, bytes = source.size): Promise<Float32Array<ArrayBuffer>> {
  return new Float32Array(await readBuffer(device, source, bytes));
}

import { DeviceError } from '../errors';
import type { Pages } from './paged/pages';
import type { ShapeBytes } from './shape-arrays';

/**
 * Which arrays of a scene are too large for a buffer that a shader binds; undefined: none.
 *
 * @throws {DeviceError} `renderer/limit` where the device cannot hold them at all.
 */
export async function choosePages(device: GPUDevice, bytes: ShapeBytes): Promise<Pages | undefined> {
  const limit = Math.min(device.limits.maxStorageBufferBindingSize, device.limits.maxBufferSize);
  if (Math.max(...Object.values(bytes)) <= limit) return undefined;
  // A chunk of its own, for most scenes have no use for it.
  const { Pages } = await import('./paged/pages');
  return new Pages(device, bytes, limit, DeviceError);
}

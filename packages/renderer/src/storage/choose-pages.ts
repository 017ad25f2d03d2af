import { loadPart } from '@glanz/wgsl';
import { DeviceError } from '../errors';
import type { Pages } from './paged/pages';
import type { ShapeArray, ShapeBytes } from './shape-arrays';

/**
 * Which arrays of a scene are too large for a buffer that a shader binds; undefined: none.
 *
 * @param present Where they lie now: what is in a texture stays in one.
 * @throws {DeviceError} `renderer/limit` where the device cannot hold them at all.
 */
export async function choosePages(device: GPUDevice, bytes: ShapeBytes, present?: Pages): Promise<Pages | undefined> {
  const limit = Math.min(device.limits.maxStorageBufferBindingSize, device.limits.maxBufferSize);
  const entries = Object.entries(bytes) as [ShapeArray, number][];
  if (entries.every(([name, size]) => size <= limit || present?.names.includes(name))) return present;
  // A chunk of its own, for most scenes have no use for it.
  const { Pages } = await loadPart('pages', import('./paged/pages'));
  return new Pages(device, bytes, limit, DeviceError, present);
}

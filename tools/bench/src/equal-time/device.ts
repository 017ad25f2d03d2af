import { requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { BenchError } from '../error';

/** A device for one contestant, whose errors are noticed. */
export interface WatchedDevice {
  readonly device: GPUDevice;
  readonly adapter: { readonly name: string; readonly software: boolean };
  /** @throws {BenchError} `bench/gpu-error` when the device has reported an error. */
  check(): void;
}

/**
 * Opens a device.
 *
 * @param name Part of the adapter's name.
 * @param what Who is measured on what, for errors.
 */
export async function watchedDevice(name: string | undefined, what: string): Promise<WatchedDevice> {
  const { gpu, adapterName, software } = await createGpu(name === undefined ? {} : { gpu: name });
  const device = await requestDevice({ gpu });
  const faults: string[] = [];
  device.addEventListener('uncapturederror', ({ error }) => void faults.push(error.message.split('\n', 1)[0]!));
  return {
    device,
    adapter: { name: adapterName, software },
    check() {
      if (faults.length > 0)
        throw new BenchError('bench/gpu-error', `${what}: ${faults.length} GPU errors, the first: ${faults[0]}`);
    },
  };
}

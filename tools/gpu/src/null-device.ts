import { createRequire } from 'node:module';

/** Devices crash once what made them is collected. */
const pinned: GPU[] = [];

/**
 * A device of Dawn's null backend, for tests of which programs and buffers are made: it has all features and validates
 * shaders, but compiles and runs nothing. Its subgroups have up to 128 threads.
 *
 * @returns The device, and the messages of its errors outside of any error scope.
 */
export async function nullDevice(
  features: string[] = [],
): Promise<{ readonly device: GPUDevice; readonly errors: readonly string[] }> {
  const { create } = createRequire(import.meta.url)('webgpu') as { create(flags: string[]): GPU };
  const gpu = create(['backend=null', 'enable-dawn-features=allow_unsafe_apis']);
  pinned.push(gpu);
  const adapter = (await gpu.requestAdapter())!;
  const device = await adapter.requestDevice({ requiredFeatures: features as GPUFeatureName[] });
  const errors: string[] = [];
  device.addEventListener('uncapturederror', (event) => {
    event.preventDefault();
    errors.push((event as GPUUncapturedErrorEvent).error.message);
  });
  return { device, errors };
}

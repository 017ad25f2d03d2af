import { expect, it } from 'vitest';
import { requestDevice } from '../../src/device/device';

/** An adapter with some features, which records what a device is requested with. */
function adapterWith(features: readonly string[]) {
  const requested: (GPUDeviceDescriptor | undefined)[] = [];
  const adapter = {
    features: new Set(features),
    limits: new Proxy({}, { get: () => 1024 }),
    requestDevice: async (descriptor?: GPUDeviceDescriptor) => {
      requested.push(descriptor);
      return {} as GPUDevice;
    },
  };
  return { gpu: { requestAdapter: async () => adapter } as unknown as GPU, requested };
}

it('devices have what an adapter offers of the features that are used, and nothing else', async () => {
  const { gpu, requested } = adapterWith([
    'shader-f16',
    'chromium-experimental-subgroup-matrix',
    'timestamp-query',
    'clip-distances',
  ]);
  await requestDevice({ gpu });
  expect(requested).toHaveLength(1);
  expect([...requested[0]!.requiredFeatures!].sort()).toEqual([
    'chromium-experimental-subgroup-matrix',
    'shader-f16',
    'timestamp-query',
  ]);
});

it('no feature is asked of an adapter that offers none', async () => {
  const { gpu, requested } = adapterWith([]);
  await requestDevice({ gpu });
  expect([...(requested[0]!.requiredFeatures ?? [])]).toEqual([]);
});

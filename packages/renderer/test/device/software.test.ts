import { describe, expect, it } from 'vitest';
import { isSoftware } from '../../src/device/software';

const info = (fields: Partial<GPUAdapterInfo>) =>
  ({
    vendor: '',
    architecture: '',
    device: '',
    description: '',
    isFallbackAdapter: false,
    ...fields,
  }) as GPUAdapterInfo;

describe('isSoftware', () => {
  it('tells software from hardware', () => {
    expect(
      isSoftware(info({ vendor: 'mesa', architecture: 'software', device: 'llvmpipe-llvm-15-0-6-256-bits-' })),
    ).toBe(true);
    expect(isSoftware(info({ vendor: 'google', architecture: 'swiftshader' }))).toBe(true);
    expect(isSoftware(info({ vendor: 'microsoft', description: 'Microsoft Basic Render Driver' }))).toBe(true);
    expect(isSoftware(info({ vendor: 'nvidia', architecture: 'hopper', device: 'nvidia-h200' }))).toBe(false);
    expect(isSoftware(info({ vendor: 'x', isFallbackAdapter: true }))).toBe(true);
  });
});

import { describe, expect, it } from 'vitest';
import { lavapipeVersion, parseAdapterList } from '../../src/node/adapter-info';

const info = (fields: Partial<GPUAdapterInfo>) =>
  ({
    vendor: '',
    architecture: '',
    device: '',
    description: '',
    isFallbackAdapter: false,
    ...fields,
  }) as GPUAdapterInfo;

describe('adapter information', () => {
  it('reads the adapters out of the message for an unknown name, equal ones too', () => {
    const message = `no suitable backends found
Available adapters:
 * backend: 'vulkan', name: 'NVIDIA H200'
 * backend: 'vulkan', name: 'NVIDIA H200'
 * backend: 'vulkan', name: 'llvmpipe (LLVM 15.0.6, 256 bits)'`;
    expect(parseAdapterList(message)).toEqual([
      { backend: 'vulkan', name: 'NVIDIA H200' },
      { backend: 'vulkan', name: 'NVIDIA H200' },
      { backend: 'vulkan', name: 'llvmpipe (LLVM 15.0.6, 256 bits)' },
    ]);
    expect(parseAdapterList('something else')).toEqual([]);
  });

  it('reads the Mesa version of lavapipe only', () => {
    expect(lavapipeVersion(info({ description: 'llvmpipe: Mesa 25.0.7-2~bpo12+1 (LLVM 15.0.6) 0.0.1' }))).toBe(25);
    expect(lavapipeVersion(info({ description: 'llvmpipe: Mesa 22.3.6 (LLVM 15.0.6)' }))).toBe(22);
    expect(lavapipeVersion(info({ description: 'radv: Mesa 25.0.7' }))).toBeUndefined();
  });
});

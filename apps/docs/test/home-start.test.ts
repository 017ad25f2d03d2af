import { isSoftware } from '@glanz/renderer';
import { describe, expect, test } from 'vitest';
import { asksForLess, hasHardware, type Wishes } from '../src/home/start';

/** A browser in which some media queries match. */
const browser = (queries: readonly string[], connection?: Wishes['navigator']['connection']): Wishes => ({
  matchMedia: (query) => ({ matches: queries.includes(query) }),
  navigator: connection ? { connection } : {},
});

describe('the viewer of the home page starts by itself', () => {
  test('unless the user asks for less motion or less data, or the connection is slow', () => {
    expect(asksForLess(browser([]))).toBe(false);
    expect(asksForLess(browser([], { saveData: false, effectiveType: '4g' }))).toBe(false);
    expect(asksForLess(browser(['(prefers-reduced-motion: reduce)']))).toBe(true);
    expect(asksForLess(browser(['(prefers-reduced-data: reduce)']))).toBe(true);
    expect(asksForLess(browser([], { saveData: true }))).toBe(true);
    for (const effectiveType of ['slow-2g', '2g', '3g'])
      expect(asksForLess(browser([], { effectiveType })), effectiveType).toBe(true);
  });

  test('where the adapter is hardware', async () => {
    const gpu = (info: Partial<GPUAdapterInfo> | undefined) => ({
      requestAdapter: () =>
        Promise.resolve(
          info && ({ info: { architecture: '', device: '', description: '', ...info } } as unknown as GPUAdapter),
        ).then((adapter) => adapter ?? null),
    });
    expect(await hasHardware(undefined)).toBe(false);
    expect(await hasHardware(gpu(undefined))).toBe(false);
    expect(await hasHardware({ requestAdapter: () => Promise.reject(new Error('no')) })).toBe(false);
    expect(await hasHardware(gpu({ vendor: 'google', architecture: 'swiftshader' }))).toBe(false);
    expect(await hasHardware(gpu({ vendor: 'mesa', description: 'llvmpipe (LLVM 15)' }))).toBe(false);
    expect(await hasHardware(gpu({ vendor: 'nvidia', isFallbackAdapter: true }))).toBe(false);
    expect(await hasHardware(gpu({ vendor: 'apple', architecture: 'metal-3' }))).toBe(true);
    // The same verdict as the renderer's.
    for (const name of [
      'SwiftShader',
      'llvmpipe',
      'lavapipe',
      'Microsoft Basic Render Driver',
      'WARP',
      'ampere',
      'rdna-3',
    ])
      for (const field of ['architecture', 'device', 'description']) {
        const info = { architecture: '', device: '', description: '', [field]: name } as unknown as GPUAdapterInfo;
        expect(await hasHardware(gpu(info)), name).toBe(!isSoftware(info));
      }
  });
});

import { parseTza } from '@glanz/denoise';
import { describe, expect, it } from 'vitest';
import { flopOf, layersOf, randomArchive } from '../src/denoise/networks';

describe.each([
  ['small', 62_136],
  ['base', 125_406],
  ['large', 312_192],
] as const)('the network %s', (size, macs) => {
  it('has the multiply-adds a pixel that were counted for Open Image Denoise', () => {
    // Counted with 3×3 kernels throughout.
    const plain = layersOf(size).reduce(
      (sum, { level, up, direct, out }) => sum + (9 * (up + direct) * out) / 4 ** level,
      0,
    );
    expect(plain).toBe(macs);
    const saved = layersOf(size).reduce((sum, { level, up, out }) => sum + (5 * up * out) / 4 ** level, 0);
    const flop = layersOf(size).reduce((sum, layer) => sum + flopOf(layer, 33, 17), 0);
    expect(flop).toBe(2 * 48 * 32 * (macs - saved));
  });

  it('is an archive that can be read', () => {
    const tensors = parseTza(randomArchive(size));
    expect(tensors.size).toBe(2 * layersOf(size).length);
    for (const { data, name } of tensors.values()) {
      const largest = data.reduce((a, b) => Math.max(a, Math.abs(b)), 0);
      if (name.endsWith('.weight')) expect(largest, name).toBeGreaterThan(0);
      expect(largest, name).toBeLessThan(1);
    }
  });
});

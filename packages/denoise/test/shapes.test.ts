import { describe, expect, it } from 'vitest';
import { chooseShape, withGroups } from '../src/kernels/choose-shape';
import { stagedUpChannels, threadsOf, tileOutputs } from '../src/kernels/shapes';
import { readNetwork } from '../src/network';
import { randomNetwork } from './random-network';

const layers = (['plain', 'large'] as const).flatMap((graph) => readNetwork(randomNetwork(9, graph)).layers);
/** The channel counts that Open Image Denoise's networks have. */
const CHANNELS = [32, 48, 64, 80, 96, 112, 128, 192, 256];

describe('the shape of a layer', () => {
  it('exists for every layer and size, within the limits of every device', () => {
    for (const layer of layers)
      for (const channels of layer.channels === 3 ? [3] : [...CHANNELS, 5, 17])
        for (const size of [16, 64, 512, 4096])
          for (const software of [false, true]) {
            const one = { ...layer, channels, upChannels: layer.up === undefined ? 0 : channels, directChannels: 64 };
            const shape = chooseShape(one, size, size / 2, software);
            expect(threadsOf(shape)).toBeLessThanOrEqual(256);
            expect(stagedUpChannels(shape, layer.up !== undefined)).toBeGreaterThan(0);
            if (layer.pool) expect(shape.rows % 2).toBe(0);
          }
  });

  it('computes few channels in vain, and spreads small layers', () => {
    const layer = layers.find(({ up, pool }) => up === undefined && !pool)!;
    for (const channels of CHANNELS) {
      const one = { ...layer, channels, directChannels: channels };
      expect(channels % tileOutputs(chooseShape(one, 1920, 1088, false)), `${channels} channels`).toBe(0);
      const sums = (size: number) => {
        const { rows, outputs } = chooseShape(one, size, size, false);
        return rows * outputs;
      };
      expect(sums(32)).toBeLessThan(sums(1024));
    }
  });

  it('does not exist where rows cannot be pooled or memory does not suffice', () => {
    const pooled = layers.find(({ pool }) => pool)!;
    expect(withGroups({ threadsX: 4, threadsY: 4, rows: 1, outputs: 4 }, pooled)).toBeUndefined();
    expect(withGroups({ threadsX: 16, threadsY: 16, rows: 4, outputs: 4 }, pooled)).toBeUndefined();
    expect(withGroups({ threadsX: 4, threadsY: 4, rows: 2, outputs: 4 }, pooled)).toBeDefined();
  });
});

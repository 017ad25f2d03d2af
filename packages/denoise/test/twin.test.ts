import { expectNoGpuErrors } from '@glanz/gpu';
import { afterEach, describe, expect, it } from 'vitest';
import { denoiseOnCpu } from '../src/cpu/index';
import { denoiseOnGpu, TWIN_CASES } from './gpu';
import { differences } from './oracle';
import { randomImages, randomNetwork } from './random-network';

afterEach(() => expectNoGpuErrors());

describe('the GPU computes what the CPU twin does', () => {
  for (const [input, channels, graph, width, height] of TWIN_CASES)
    it(`${input}, ${channels} channels, ${graph}, ${width} × ${height}`, async () => {
      const weights = randomNetwork(channels, graph);
      const images = randomImages(width, height);
      const { rgb } = await denoiseOnGpu(weights, images, { input, storage: 'f32' });
      const expected = await denoiseOnCpu(weights, images, { input });
      // What f32 rounds in sums of some thousand products, and the functions of a driver; HDR's curve magnifies it.
      const { max, absolute } = differences(rgb, expected);
      expect(input === 'hdr' ? max : absolute).toBeLessThan(input === 'hdr' ? 2e-4 : 2e-5);
      // An image of few values would show nothing; a channel may be black.
      if (width > 1) expect(new Set(expected).size).toBeGreaterThan((width * height) / 4);
    });

  it('with a scale that is given', async () => {
    const weights = randomNetwork(3);
    const images = { ...randomImages(20, 20), scale: 3 };
    const { rgb } = await denoiseOnGpu(weights, images, { input: 'hdr', storage: 'f32' });
    const expected = await denoiseOnCpu(weights, images);
    expect(differences(rgb, expected).max).toBeLessThan(2e-4);
    const automatic = await denoiseOnCpu(weights, { ...images, scale: undefined as unknown as number });
    expect(differences(automatic, expected).max).toBeGreaterThan(1e-3);
  });

  it('of a black image', async () => {
    const weights = randomNetwork(3);
    const images = { width: 20, height: 20, color: new Float32Array(1200) };
    const { rgb } = await denoiseOnGpu(weights, images, { input: 'hdr', storage: 'f32' });
    expect(differences(rgb, await denoiseOnCpu(weights, images)).max).toBeLessThan(2e-4);
  });

  it('with guides that networks of their own clean first', async () => {
    const weights = randomNetwork(9);
    const prefilter = { albedo: randomNetwork(3, 'plain', 2), normal: randomNetwork(3, 'large', 3) };
    const images = randomImages(40, 24);
    const { rgb } = await denoiseOnGpu(weights, images, { input: 'hdr', storage: 'f32', prefilter });
    const expected = await denoiseOnCpu(weights, images, { prefilter });
    expect(differences(rgb, expected).max).toBeLessThan(2e-4);
    // By hand: each network alone.
    const albedo = await denoiseOnCpu(prefilter.albedo, images, { input: 'albedo' });
    const normal = await denoiseOnCpu(prefilter.normal, images, { input: 'normal' });
    expect(await denoiseOnCpu(weights, { ...images, albedo, normal })).toEqual(expected);
    expect(differences(await denoiseOnCpu(weights, images), expected).max).toBeGreaterThan(1e-3);
  });
});

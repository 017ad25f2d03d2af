import { describe, expect, it } from 'vitest';
import { relMse } from '@glanz/reference';
import { displayed, noiseOf, imageError, shrink, type Reference } from '../../src/equal-time/images';

function random(seed: number): () => number {
  let state = seed;
  const uniform = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
  // Sum of uniforms: about normal, mean 0, variance 1.
  return () => Array.from({ length: 12 }, uniform).reduce((a, b) => a + b, -6);
}

const SIZE = 48;
const truth = Float32Array.from({ length: 3 * SIZE * SIZE }, (_, i) => 0.4 + 0.3 * Math.sin(i * 0.013) + 0.1 * (i % 3));
const withNoise = (sigma: number, seed: number) => {
  const normal = random(seed);
  return truth.map((value) => value + sigma * normal());
};
const reference = (sigma: number, seed: number): Reference => ({
  width: SIZE,
  height: SIZE,
  mean: withNoise(sigma, seed),
  standardError: new Float32Array(truth.length).fill(sigma),
});

describe('imageError', () => {
  it('is relMSE as the ground truth defines it, where the reference is exact', () => {
    const exact: Reference = { width: SIZE, height: SIZE, mean: truth, standardError: new Float32Array(truth.length) };
    const image = withNoise(0.05, 3);
    const epsilon = (0.01 * truth.reduce((sum, value) => sum + value * value, 0)) / truth.length;
    const { relMse: found, relMseWithReference, brightness } = imageError(image, exact);
    expect(found).toBeCloseTo(relMse(image, truth, epsilon), 10);
    expect(relMseWithReference).toBe(found);
    expect(brightness).toBeCloseTo(1, 2);
  });

  it("subtracts the reference's noise: the same error is found with an exact and with a noisy reference", () => {
    const image = withNoise(0.02, 3);
    const exact = imageError(image, { ...reference(0, 5), mean: truth });
    const noisy = imageError(image, reference(0.02, 5));
    expect(noisy.relMse / exact.relMse).toBeGreaterThan(0.9);
    expect(noisy.relMse / exact.relMse).toBeLessThan(1.1);
    expect(noisy.relMseWithReference / exact.relMse).toBeGreaterThan(1.8);
  });

  it('FLIP is 0 for the reference itself and grows with noise', () => {
    const exact: Reference = { ...reference(0, 1), mean: truth };
    expect(imageError(truth, exact).flip).toBe(0);
    expect(imageError(withNoise(0.1, 2), exact).flip).toBeGreaterThan(imageError(withNoise(0.02, 2), exact).flip);
  });
});

describe('noiseOf', () => {
  it('is the relMSE of unbiased images, and blind to a bias that both share', () => {
    const exact: Reference = { ...reference(0, 1), mean: truth };
    const [a, b] = [withNoise(0.05, 11), withNoise(0.05, 12)];
    expect(noiseOf(a, b, exact) / imageError(a, exact).relMse).toBeCloseTo(1, 1);
    const biased = (p: Float32Array) => p.map((value) => value * 1.5);
    expect(noiseOf(biased(a), biased(b), exact) / noiseOf(a, b, exact)).toBeCloseTo(2.25, 4);
  });
});

describe('shrink', () => {
  it('takes means of blocks, by channel', () => {
    const image = Float32Array.from({ length: 3 * 4 * 2 }, (_, i) => i);
    expect([...shrink(image, 4, 2, 2)]).toEqual([7.5, 8.5, 9.5, 13.5, 14.5, 15.5]);
  });
  it('wants whole blocks', () => {
    expect(() => shrink(new Float32Array(3 * 9), 3, 3, 2)).toThrow(RangeError);
  });
});

it('what is displayed lies within 0..1, dark to light', () => {
  const shown = displayed(Float32Array.of(0, 0.2, 1, 5, 100, 1e6));
  for (const value of shown) expect(value >= 0 && value <= 1).toBe(true);
  expect(shown[1]!).toBeGreaterThan(0.3);
});

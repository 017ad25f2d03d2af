import { expect, it } from 'vitest';
import { crossCheck } from '../../src/equal-time/reference';

const SIZE = 64;
const COUNT = 3 * SIZE * SIZE;

function image(sigma: number, bias: number, seed: number): Float32Array {
  let state = seed;
  const uniform = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
  return Float32Array.from(
    { length: COUNT },
    () => 0.5 * (1 + bias) + sigma * (Array.from({ length: 12 }, uniform).reduce((a, b) => a + b, 0) - 6),
  );
}

const sigma = 0.02;
const reference = {
  width: SIZE,
  height: SIZE,
  mean: image(sigma, 0, 1),
  standardError: new Float32Array(COUNT).fill(sigma),
};
const check = (bias: number) =>
  crossCheck({ image: image(sigma, bias, 2), variance: new Float32Array(COUNT).fill(sigma ** 2) }, reference);

it('finds nothing where only noise differs', () => {
  const { ratio, ratio95, outside, blocks } = check(0);
  expect(Math.abs(ratio - 1)).toBeLessThan(ratio95);
  expect(outside).toBeLessThanOrEqual(2);
  expect(blocks).toBe(256);
});

it('finds a bias of 3 %', () => {
  const { ratio, ratio95, outside } = check(0.03);
  expect(ratio - 1).toBeGreaterThan(3 * ratio95);
  expect(outside).toBeGreaterThan(0);
});

import { expect, test } from 'vitest';
import { crossing } from '../src/denoise/crossing';

const falling = (rate: number) => [1, 2, 4, 8].map((milliseconds) => ({ milliseconds, error: milliseconds ** -rate }));

test('an error that falls by a power of time crosses a limit where the power says', () => {
  expect(crossing(falling(0.5), 0.6)).toBeCloseTo(0.6 ** -2, 9);
  expect(crossing(falling(1), 0.2)).toBeCloseTo(5, 9);
});

test('the first point counts where it is low enough, none where the last is not', () => {
  expect(crossing(falling(1), 1.5)).toBe(1);
  expect(crossing(falling(1), 0.1)).toBeUndefined();
  expect(crossing([], 0.1)).toBeUndefined();
});

test('an error that rises again above the limit crosses it later', () => {
  const errors = [0.2, 0.04, 0.08, 0.02].map((error, i) => ({ milliseconds: 2 ** i, error }));
  expect(crossing(errors, 0.05)).toBeCloseTo(4 * 2 ** (Math.log(0.08 / 0.05) / Math.log(0.08 / 0.02)), 9);
});

import { requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { describe, expect, it } from 'vitest';
import { slope, soak, soakPlot } from '../../src/faults/soak';

describe('slope', () => {
  it('is that of a line', () => {
    const { slope: value, ci95 } = slope([
      [0, 3],
      [1, 5],
      [2, 7],
      [5, 13],
    ]);
    expect(value).toBeCloseTo(2, 12);
    expect(ci95).toBeCloseTo(0, 12);
  });

  it('comes with an interval: computed on paper for four points', () => {
    // Residuals ∓0.5 ±0.5 about y = 0.2 x + 0.2: sum of squares 0.8, over 2 degrees of freedom and Σ(x − x̄)² = 5.
    const { slope: value, ci95 } = slope([
      [0, 0],
      [1, 1],
      [2, 0],
      [3, 1],
    ]);
    expect(value).toBeCloseTo(0.2, 12);
    expect(ci95).toBeCloseTo(1.96 * Math.sqrt(0.8 / 2 / 5), 12);
  });
});

it('ten seconds of loads, edits and losses leave no GPU object and no unexpected error', async () => {
  const { gpu } = await createGpu({ software: 'only' });
  const { points, loads, edits, errors } = await soak({
    open: () => requestDevice({ gpu }),
    seconds: 10,
    seed: 7,
    lossRate: 0.02,
  });
  expect(errors).toEqual([]);
  expect([loads > 0, edits > 0, points.length > 0]).toEqual([true, true, true]);
  expect(points.filter(({ gpuObjects, gpuBytes }) => gpuObjects > 0 || gpuBytes > 0)).toEqual([]);
  expect(soakPlot(points, 5)).toMatch(/^<svg [^]*polyline[^]*<\/svg>\n$/);
});

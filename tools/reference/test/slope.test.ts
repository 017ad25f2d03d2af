import { testDevice } from '@glanz/gpu';
import { describe, expect, it } from 'vitest';
import { GroundTruth, convergenceSlope, measureConvergence } from '../src/index';

describe('convergenceSlope', () => {
  it('of c / N is −1; an error that stays lifts it', () => {
    const points = [4, 8, 16, 64].map((samples) => ({ samples, error: 0.3 / samples }));
    expect(convergenceSlope(points)).toBeCloseTo(-1, 12);
    expect(convergenceSlope(points.map(({ samples, error }) => ({ samples, error: error + 0.002 })))).toBeGreaterThan(
      -0.95,
    );
  });
});

describe('measureConvergence', () => {
  it('a renderer without bias converges as one over the number of samples', async () => {
    const counts = process.env['GLANZ_FULL'] === undefined ? [2, 4, 8] : [2, 4, 8, 16, 32];
    const points = await measureConvergence(await testDevice(), new GroundTruth('cornell_diffuse'), counts, 2);
    // 128 × 128 pixels and two runs: the slope's own error is about 0.012 for four numbers of samples, 0.019 for three.
    expect(Math.abs(convergenceSlope(points) + 1)).toBeLessThan(0.05);
  }, 300_000);
});

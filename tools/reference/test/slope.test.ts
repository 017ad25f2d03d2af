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
  // 128 × 128 pixels and two runs: the slope's own error is about 0.012 for four numbers of samples of the box, 0.013
  // for three of the textured plane, whose paths are short (0.018 between ten seeds). Without GLANZ_FULL the ground
  // truth (groundtruth.test.ts) notices a bias, and samples that repeat, by the noise that they leave.
  it.runIf(process.env['GLANZ_FULL'] !== undefined).each([
    ['textured', [2, 4, 8]],
    ['cornell_diffuse', [2, 4, 8, 16, 32]],
  ] as const)(
    '%s: a renderer without bias converges as one over the number of samples',
    async (scene, counts) => {
      const points = await measureConvergence(await testDevice(), new GroundTruth(scene), counts, 2);
      expect(Math.abs(convergenceSlope(points) + 1)).toBeLessThan(0.05);
    },
    300_000,
  );
});

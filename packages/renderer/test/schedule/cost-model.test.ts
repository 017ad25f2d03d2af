import { describe, expect, it } from 'vitest';
import { CostModel } from '../../src/schedule/cost-model';

describe('CostModel', () => {
  it('finds the line that the times lie on', () => {
    const model = new CostModel();
    expect([model.fixed, model.isFixedKnown, model.mean, model.peak]).toEqual([0, false, undefined, 0]);
    for (let i = 0; i < 40; i++) {
      const size = i % 2 ? 1000 : 4000;
      model.measured(size, 2 + size * 0.003);
    }
    expect(model.isFixedKnown).toBe(true);
    expect(model.fixed).toBeCloseTo(2, 6);
    expect(model.mean).toBeCloseTo(0.003, 5);
    expect(model.peak).toBeCloseTo(0.003, 4);
  });

  it('does not take sizes that hardly differ for evidence', () => {
    const model = new CostModel();
    model.measured(1000, 5);
    model.measured(1400, 9);
    expect(model.isFixedKnown).toBe(false);
    expect(model.fixed).toBe(0);
  });

  it('follows the mean, and remembers the peak for some pieces', () => {
    const model = new CostModel();
    model.measured(1000, 10);
    for (let i = 0; i < 10; i++) model.measured(1000, 1);
    expect(model.mean).toBeLessThan(0.0013);
    expect(model.peak).toBeCloseTo(0.01 * 0.93 ** 10, 9);
  });

  it('takes nothing that is the same for all sizes for the cost of a unit, once it is known', () => {
    const model = new CostModel();
    model.measured(1000, 10 + 0.001 * 1000);
    expect(model.peak).toBeCloseTo(0.011, 9);
    model.measured(2000, 10 + 0.001 * 2000);
    expect(model.fixed).toBeCloseTo(9.9, 1);
    // 90 % of the shortest at most: 0.0011 of the small piece, 0.00105 of the large one.
    expect(model.peak).toBeLessThan(0.0012);
  });

  it('never claims more for the fixed part than a piece took, whatever the noise', () => {
    const model = new CostModel();
    for (let i = 0; i < 200; i++) {
      const milliseconds =
        1 + 5 * Math.abs(Math.sin(i * 12.9898) * 43758.5453 - Math.floor(Math.sin(i * 12.9898) * 43758.5453));
      model.measured(i % 3 === 0 ? 100 : 1000, milliseconds);
      expect(model.fixed).toBeLessThan(6);
      expect(model.fixed).toBeGreaterThanOrEqual(0);
      expect(model.mean).toBeGreaterThanOrEqual(0);
    }
  });
});

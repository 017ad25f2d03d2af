import { describe, expect, it } from 'vitest';
import { fairQuantity, joinDetails, overall, ratios, valueAfter, valueAt } from '../../src/equal-time/summary';
import { geometricMean } from '../../src/geometric-mean';
import { DETAILS, measurement } from './details';

const PEER = 'three-gpu-pathtracer';

describe('comparisons', () => {
  it('says how many times lower the error is at each budget', () => {
    for (const ratio of ratios(DETAILS, 'box', PEER, 'relMSE')!) expect(ratio).toBeCloseTo(100, 6);
    for (const ratio of ratios(DETAILS, 'product', PEER, 'noise')!) expect(ratio).toBeCloseTo(16, 6);
    for (const ratio of ratios(DETAILS, 'box', PEER, 'FLIP')!) expect(ratio).toBeCloseTo(10, 6);
  });

  it('at equal wall time gives Glanz the time that the peer took: twice as long, half the error', () => {
    for (const ratio of ratios(DETAILS, 'box', PEER, 'relMSE', 'wallMs')!) expect(ratio).toBeCloseTo(200, 6);
  });

  it('is silent where something was not measured', () => {
    expect(ratios(DETAILS, 'product', 'three-gpu-pathtracer (defaults)', 'relMSE')).toBeUndefined();
    expect(ratios({ ...DETAILS, runs: 1 }, 'box', PEER, 'noise')).toBeUndefined();
  });

  it('takes the geometric mean over scenes and budgets', () => {
    expect(geometricMean([1, 100])).toBeCloseTo(10, 12);
    const whole = overall(DETAILS, PEER, fairQuantity)!;
    expect(whole.count).toBe(4);
    expect(whole.mean).toBeCloseTo(40, 6);
    expect([whole.min, whole.max].map(Math.round)).toEqual([16, 100]);
    expect(
      overall(DETAILS, 'three-gpu-pathtracer (defaults)', ({ truth }) => (truth === 'own' ? 'relMSE' : undefined)),
    ).toBeUndefined();
  });
});

describe('values', () => {
  it('lie on straight lines of logarithms, also beyond the measured points', () => {
    const m = measurement('box', 'glanz', 1e-4);
    for (const t of [10, 100, 300, 1000, 5000]) expect(valueAfter(m, 'relMSE', 'gpuMs', t) * t).toBeCloseTo(0.1, 8);
  });

  it("never go below what the reference's noise resolves", () => {
    const m = measurement('box', 'glanz', 1e-4);
    const sunk = {
      ...m,
      points: m.points.map((run) => run.map((point) => ({ ...point, relMse: -1e-6, relMseWithReference: 1e-4 }))),
    };
    expect(valueAt(sunk, 'relMSE', 0)).toBeCloseTo(0.05 * 1.01e-4, 10);
  });
});

describe('pieces', () => {
  const piece = (name: string) => ({
    ...DETAILS,
    scenes: DETAILS.scenes.filter((scene) => scene.name === name),
    measurements: DETAILS.measurements.filter(({ scene }) => scene === name),
    crossChecks: DETAILS.crossChecks.filter(({ scene }) => scene === name),
  });

  it('are the whole when joined, and a scene that was measured again counts as it was last', () => {
    expect(joinDetails([piece('box'), piece('product')])).toEqual(DETAILS);
    const again = { ...piece('box'), measurements: [measurement('box', 'glanz', 5e-5)] };
    const joined = joinDetails([DETAILS, again]);
    expect(joined.scenes).toEqual(DETAILS.scenes);
    expect(joined.measurements).toEqual([...again.measurements, ...piece('product').measurements]);
  });

  it('of different sizes are refused', () => {
    expect(() => joinDetails([piece('box'), { ...piece('product'), size: 256 }])).toThrow(/different measurements/);
  });
});

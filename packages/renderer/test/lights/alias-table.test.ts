import { describe, expect, it } from 'vitest';
import { buildAliasTable } from '../../src/lights/alias-table';

describe('buildAliasTable', () => {
  it('returns exactly the probabilities it was built from', () => {
    const weights = [0, 1, 5, 0.25, 1e-9, 3, 0, 40];
    const table = buildAliasTable(weights);
    expect(table).toBeDefined();
    if (!table) return;
    const total = weights.reduce((a, b) => a + b);
    const drawn = new Float64Array(weights.length);
    for (let i = 0; i < weights.length; i++) {
      drawn[i] = (drawn[i] as number) + (table.keep[i] as number) / weights.length;
      const alias = table.alias[i] as number;
      drawn[alias] = (drawn[alias] as number) + (1 - (table.keep[i] as number)) / weights.length;
    }
    weights.forEach((w, i) => {
      expect(drawn[i]).toBeCloseTo(w / total, 12);
      expect(table.probability[i]).toBeCloseTo(w / total, 12);
    });
  });

  it('has nothing to draw from zero or broken weights', () => {
    expect(buildAliasTable([])).toBeUndefined();
    expect(buildAliasTable([0, 0])).toBeUndefined();
    expect(buildAliasTable([1, Infinity])).toBeUndefined();
    expect(buildAliasTable([1, Number.NaN])).toBeUndefined();
  });
});

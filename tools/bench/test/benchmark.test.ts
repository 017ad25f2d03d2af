import { readFileSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { describe, expect, it, vi } from 'vitest';
import { estimated, timed, wallTimes, type Benchmark } from '../src/benchmark';
import { figureLine, runBenchmark } from '../src/runner';

describe('figures', () => {
  it('takes the median of odd and even counts', () => {
    expect(timed('a', 'ms', [3, 1, 2])).toMatchObject({ runs: 3, min: 1, median: 2, max: 3 });
    expect(timed('a', 'ms', [4, 1, 2, 3])).toMatchObject({ min: 1, median: 2.5, max: 4 });
  });

  it("gives Student's interval: known table value for four runs", () => {
    // Standard deviation 1 of 4 values: 3.182 / √4.
    const values = [-1, 1, -1, 1].map((x) => 5 + x * Math.sqrt(3 / 4));
    const { mean, ci95 } = estimated('a', '1', values);
    expect(mean).toBeCloseTo(5, 12);
    expect(ci95).toBeCloseTo(3.182 / 2, 6);
  });

  it('covers the truth in 95 % of cases (4,000 trials of 5 uniform values)', () => {
    let state = 12345;
    const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
    let covered = 0;
    for (let i = 0; i < 4000; i++) {
      const { mean, ci95 } = estimated('a', '1', Array.from({ length: 5 }, random));
      if (Math.abs((mean as number) - 0.5) <= (ci95 as number)) covered++;
    }
    // A uniform distribution covers a little less than a normal one.
    expect(covered / 4000).toBeGreaterThan(0.92);
    expect(covered / 4000).toBeLessThan(0.97);
  });

  it('says whether a target is met', () => {
    const target = { value: 2, relation: '<=' as const, source: 'test' };
    expect(figureLine(timed('a', 'ms', [1], target))).toContain('meets');
    expect(figureLine(timed('a', 'ms', [3], target))).toContain('MISSES');
  });

  it('does not count warm-up runs', async () => {
    let calls = 0;
    expect(await wallTimes(3, 2, () => calls++)).toHaveLength(3);
    expect(calls).toBe(5);
  });
});

describe('runBenchmark', () => {
  const benchmark: Benchmark = {
    description: 'test',
    run: ({ quick, gpu }) => Promise.resolve({ settings: { quick, gpu }, figures: [timed('a', 'ms', [1, 2, 3])] }),
  };

  it('writes machine, settings and figures as JSON', async () => {
    const folder = mkdtempSync(join(tmpdir(), 'glanz-bench-'));
    const print = vi.spyOn(process.stdout, 'write').mockReturnValue(true);
    try {
      await runBenchmark('test', benchmark, ['--json', join(folder, 'deep/out.json'), '--quick', '--gpu', 'x']);
      const report = JSON.parse(readFileSync(join(folder, 'deep/out.json'), 'utf8')) as Record<string, unknown>;
      expect(report).toMatchObject({
        benchmark: 'test',
        quick: true,
        settings: { quick: true, gpu: 'x' },
        figures: [{ name: 'a', unit: 'ms', runs: 3, min: 1, median: 2, max: 3 }],
      });
      expect(report['machine']).toMatchObject({
        cpu: expect.any(String) as string,
        cores: expect.any(Number) as number,
        node: process.version,
      });
    } finally {
      print.mockRestore();
      rmSync(folder, { recursive: true });
    }
  });

  it('refuses unknown options in one line', async () => {
    await expect(runBenchmark('test', benchmark, ['--nope'])).rejects.toMatchObject({
      code: 'bench/option',
      message: expect.not.stringContaining('\n') as string,
    });
  });
});

import { describe, expect, it } from 'vitest';
import type { Contestant } from '../../src/equal-time/contestant';
import { timedSamples } from '../../src/products/measure';

const DEPTH = 4;

/** A renderer of which `perSample` units make a sample, and a clock by which a unit takes 2 ms and 10 submissions. */
function fake(unit: Contestant['unit'], perSample: number) {
  let units = 0;
  const parts: number[] = [];
  const contestant = {
    unit,
    advance: (more: number) => {
      parts.push(more);
      units += more;
      return Promise.resolve();
    },
    samples: () => Promise.resolve(units / perSample),
  } as unknown as Contestant;
  const time = {
    async measure(work: () => Promise<void>) {
      const before = units;
      await work();
      const done = units - before;
      return { gpuMs: 2 * done, wallMs: 3 * done, submissions: 10 * done };
    },
    max: ({ submissions }: { submissions: number }) => Math.floor(1900 / submissions),
  };
  return { contestant, time, parts };
}

describe('timed samples', () => {
  it('are as many whole samples as requested, in parts that the clock holds', async () => {
    const { contestant, time, parts } = fake('samples', 1);
    expect(await timedSamples(contestant, time, 300, DEPTH)).toEqual({ samples: 300, gpuMs: 600, wallMs: 900 });
    expect(Math.max(...parts)).toBeLessThanOrEqual(190);
  });

  it('go on in rounds until there are enough, and not much further', async () => {
    const { contestant, time } = fake('rounds', 3.5);
    const { samples, gpuMs } = await timedSamples(contestant, time, 64, DEPTH);
    expect(samples).toBeGreaterThanOrEqual(64);
    expect(samples).toBeLessThan(66);
    expect(gpuMs).toBeCloseTo(2 * 3.5 * samples, 9);
  });

  it('give up where nothing gets done', async () => {
    const { contestant, time } = fake('rounds', Infinity);
    await expect(timedSamples(contestant, time, 2, DEPTH)).rejects.toMatchObject({ code: 'bench/failed' });
  });
});

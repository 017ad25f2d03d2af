import { describe, expect, it } from 'vitest';
import { renderShutter, shutterTimes, type ShutterTracer } from '../src/shutter';

describe('times of an open shutter', () => {
  it('lie in strata that are as long as their shares of the samples', () => {
    for (const [samples, times] of [
      [1, 1],
      [64, 64],
      [10, 4],
      [7, 100],
    ] as const) {
      const list = shutterTimes({ samples, times, seed: 5 });
      expect(list.length).toBe(Math.min(samples, times));
      let from = 0;
      for (const { time, until } of list) {
        expect(Number.isInteger(until) && until > from).toBe(true);
        expect(time).toBeGreaterThanOrEqual(from / samples);
        expect(time).toBeLessThan(until / samples);
        from = until;
      }
      expect(from).toBe(samples);
    }
  });

  it('are uniformly distributed in their strata, independently of one another', () => {
    // Seeds and strata that follow one another, as frames of a film do.
    const [seeds, strata, bins] = [500, 8, 10];
    const counts = new Array<number>(bins).fill(0);
    let product = 0;
    for (let seed = 0; seed < seeds; seed++) {
      const places = shutterTimes({ samples: strata, seed }).map(({ time }, i) => time * strata - i);
      places.forEach((place, i) => {
        counts[Math.floor(bins * place)]!++;
        if (i > 0) product += (place - 0.5) * (places[i - 1]! - 0.5);
      });
    }
    const expected = (seeds * strata) / bins;
    const chi2 = counts.reduce((sum, count) => sum + (count - expected) ** 2 / expected, 0);
    // The 99.9 % quantile for 9 degrees of freedom.
    expect(chi2).toBeLessThan(27.88);
    // The variance of a product is 1/144; 3.3 standard deviations.
    const pairs = seeds * (strata - 1);
    expect(Math.abs(product / pairs)).toBeLessThan(3.3 / 12 / Math.sqrt(pairs));
  });

  it('give every sample its share of the time: a linear function has its mean on average', () => {
    const seeds = 2000;
    let sum = 0;
    for (let seed = 0; seed < seeds; seed++) {
      let from = 0;
      for (const { time, until } of shutterTimes({ samples: 5, times: 2, seed })) {
        sum += (time * (until - from)) / 5 / seeds;
        from = until;
      }
    }
    // Two of five samples share a time, and three: variance (0.4⁴ + 0.6⁴) / 12. 3.3 standard deviations.
    expect(Math.abs(sum - 0.5)).toBeLessThan(3.3 * Math.sqrt((0.4 ** 4 + 0.6 ** 4) / 12 / seeds));
  });

  it('are refused for what are no whole numbers', () => {
    for (const settings of [{ samples: 0 }, { samples: 1.5 }, { samples: 4, times: 0 }])
      expect(() => shutterTimes(settings)).toThrow(expect.objectContaining({ code: 'renderer/samples' }));
  });
});

it('a film that others restart repeatedly is given up', async () => {
  let rendered = 0;
  const tracer: ShutterTracer = {
    accumulates: false,
    samples: 0,
    reset: () => undefined,
    async *render() {
      rendered++;
      yield* [];
    },
  };
  const rendering = renderShutter(tracer, { samples: 2, pose: () => undefined }).next();
  await expect(rendering).rejects.toMatchObject({ code: 'renderer/shutter' });
  expect(rendered).toBe(4);
  expect(tracer.accumulates).toBe(false);
});

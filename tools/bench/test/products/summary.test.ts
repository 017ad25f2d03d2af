import { describe, expect, it } from 'vitest';
import type { ProductMeasurement, RendererName } from '../../src/products/measure';
import { errorAfter, figuresOf, meansOf, productTable, remarks } from '../../src/products/summary';

/** Two runs of 10 samples: 2 and 4 ms a sample, and relMSE × samples of `error` less and more a half. */
function measurement(product: string, renderer: RendererName, error: number, own = 1e-6): ProductMeasurement {
  return {
    product,
    renderer,
    width: 32,
    height: 18,
    adapter: { name: 'test', software: false },
    stamped: true,
    setUpMs: 500,
    runs: [0.5, 1.5].map((factor, i) => ({
      samples: 10,
      gpuMs: 20 + 20 * i,
      wallMs: 40 + 40 * i,
      relMse: (error * factor) / 10,
      relMseWithReference: (error * factor) / 10 + own,
      brightness: 1,
    })),
    noise: [error],
    ...(renderer === 'glanz'
      ? {
          reference: {
            ownRelMse: own,
            samples: 64,
            checkSamples: 16,
            ratio: 1.01,
            ratio95: 0.02,
            outside: 0,
            blocks: 256,
          },
        }
      : {}),
  };
}

const all = [
  measurement('a', 'glanz', 0.1),
  measurement('a', 'three-gpu-pathtracer', 1),
  measurement('b', 'glanz', 0.1),
  measurement('b', 'three-gpu-pathtracer', 4),
  measurement('c', 'glanz', 0.1),
];
const figure = (name: string, judge = true) => figuresOf(all, judge).find((one) => one.name === name);

describe('figures of products', () => {
  it('have time and error per sample with their spread', () => {
    expect(figure('a, 32 × 18: GPU time a sample')).toMatchObject({ unit: 'ms', runs: 2, min: 2, median: 3, max: 4 });
    const error = figure('a, 32 × 18: relMSE × samples')!;
    expect(error.mean).toBeCloseTo(0.1, 12);
    // Student's t of two values 0.05 and 0.15.
    expect(error.ci95).toBeCloseTo(12.706 * 0.05, 12);
    expect(figure('a, 32 × 18, three-gpu-pathtracer: relMSE × samples')!.mean).toBeCloseTo(1, 12);
  });

  it('compare noise at equal time, and all products by the geometric mean', () => {
    const name = "noise × wall time, three-gpu-pathtracer's over Glanz's, geometric mean";
    const whole = figure(name)!;
    expect([whole.min, whole.median, whole.max].map((value) => Number(value!.toFixed(9)))).toEqual([10, 20, 40]);
    expect(whole.runs).toBe(2);
    expect(whole.target?.value).toBe(20);
    expect(figure(name, false)!.target).toBeUndefined();
  });

  it('compare errors after a second, in which what is no noise stays', () => {
    // 6 ms a sample (the median of 4 and 8): noise 0.3 of a sample falls to 0.3 × 6 / 1000, and 0.02 stays.
    const [one] = all as [ProductMeasurement];
    const biased = {
      ...one,
      noise: [0.2, 0.4],
      runs: one.runs.map((run, i) => ({ ...run, relMse: [0.04, 0.06][i]! })),
    };
    expect(errorAfter(biased, 1000)).toBeCloseTo(0.0018 + 0.02, 12);
    // Twice the time halves the noise alone.
    expect(errorAfter(biased, 2000)).toBeCloseTo(0.0009 + 0.02, 12);
    // There is no image of less than a sample.
    expect(errorAfter(biased, 1)).toBeCloseTo(0.3 + 0.02, 12);
    // An error that is less than the noise is no negative bias.
    expect(errorAfter({ ...biased, noise: [0.9] }, 1000)).toBeCloseTo(0.0054, 12);
    // In these there is noise alone: the ratio is that of noise × time, unless there is a bias.
    const name = "a, 32 × 18: relMSE after 1 s of wall time, three-gpu-pathtracer's over Glanz's";
    expect(figure(name)!.median).toBeCloseTo(10, 9);
    const whole = figure("relMSE after 1 s of wall time, three-gpu-pathtracer's over Glanz's, geometric mean")!;
    expect([whole.min, whole.median, whole.max].map((value) => Number(value!.toFixed(9)))).toEqual([10, 20, 40]);
    expect(meansOf(figuresOf(all, true))).toEqual({ noise: '20.0', error: '20.0' });
    expect(meansOf(figuresOf([one], true))).toEqual({ noise: '–', error: '–' });
  });

  it('state the error of the reference, and its brightness without an interval where there is none', () => {
    expect(figure('a, 32 × 18: relMSE of the reference itself')!.median).toBe(1e-6);
    const name = "a, 32 × 18: brightness with other random numbers over the reference's";
    expect(figure(name)).toMatchObject({ mean: 1.01, ci95: 0.02 });
    const [one] = all as [ProductMeasurement];
    const few = { ...one, reference: { ...one.reference!, ratio95: Infinity } };
    const found = figuresOf([few], true).find((other) => other.name === name)!;
    expect(found.median).toBe(1.01);
    expect(found.ci95).toBeUndefined();
  });

  it('are unique by name', () => {
    const names = figuresOf(all, true).map(({ name }) => name);
    expect(new Set(names).size).toBe(names.length);
  });
});

it('writes a line for each product, with dashes where the peer is absent', () => {
  const lines = productTable(all).split('\n');
  expect(lines).toHaveLength(5);
  expect(new Set(lines.map((line) => line.split('|').length)).size).toBe(1);
  expect(lines[2]).toBe('| a | 32 × 18 | 500 | 3 | 0.1 | 1.0e-6 | 500 | 3 | 1 | 1 | 10 | 10 |');
  expect(lines[4]).toBe('| c | 32 × 18 | 500 | 3 | 0.1 | 1.0e-6 | – | – | – | – | – | – |');
});

it('says when the reference is too noisy for what is measured, or times are not of the GPU', () => {
  expect(remarks(all)).toEqual([]);
  expect(remarks([measurement('a', 'glanz', 0.1, 0.01)])).toEqual([expect.stringContaining('50 %')]);
  const checked = (found: { readonly ratio?: number; readonly outside?: number }) => {
    const [one] = all as [ProductMeasurement];
    const checkedBy = { sampler: 'independent', guiding: 1, lightPaths: 0.25, lightCandidates: 4 } as const;
    return remarks([{ ...one, reference: { ...one.reference!, checkedBy, ...found } }]);
  };
  // The interval of 95 % is ± 0.02: three standard errors are 0.0306.
  expect(checked({ ratio: 1.03, outside: 7 })).toEqual([]);
  expect(checked({ ratio: 0.969 })).toEqual([
    expect.stringContaining('another estimator (16 samples) the image has 0.969'),
  ]);
  expect(checked({ outside: 8 })).toEqual([expect.stringContaining('8 of 256 blocks')]);
  expect(remarks([{ ...all[0]!, stamped: false }])).toEqual([expect.stringContaining('wall times')]);
});

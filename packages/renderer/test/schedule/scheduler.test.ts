import { describe, expect, it } from 'vitest';
import { Scheduler, type Batch } from '../../src/schedule/scheduler';

/** Runs a scheduler against a pretended GPU and checks that every pixel gets every sample once, in order. */
function simulate(
  pixels: number,
  capacity: number,
  budgetMs: number,
  samples: number,
  cost: (paths: number, turn: number) => number,
): { batches: Batch[]; times: number[] } {
  const scheduler = new Scheduler({ pixels, capacity, budgetMs });
  const counts = new Uint32Array(pixels);
  const batches: Batch[] = [];
  const times: number[] = [];
  for (let turn = 0; turn < 1e6; turn++) {
    const batch = scheduler.next(samples);
    if (!batch) break;
    expect(batch.pixelCount * batch.sampleCount).toBeLessThanOrEqual(capacity);
    for (let p = batch.pixelOffset; p < batch.pixelOffset + batch.pixelCount; p++) {
      if (counts[p] !== batch.sampleOffset)
        throw new Error(`pixel ${p} has ${counts[p]} samples, the batch starts at ${batch.sampleOffset}`);
      counts[p] = (counts[p] as number) + batch.sampleCount;
    }
    const time = cost(batch.pixelCount * batch.sampleCount, turn);
    scheduler.measured(batch, time);
    batches.push(batch);
    times.push(time);
  }
  expect(counts.every((n) => n === samples)).toBe(true);
  expect(scheduler.samples).toBe(samples);
  return { batches, times };
}

describe('Scheduler', () => {
  it('gives every pixel every sample once, in order, whatever the speed', () => {
    for (const [pixels, capacity] of [
      [1, 64],
      [9216, 65536],
      [262144, 1 << 20],
      [100_003, 70_000],
    ] as const) {
      simulate(pixels, capacity, 30, 17, (paths) => paths / 20_000);
    }
  });

  it('stays near its budget once it has learned the speed', () => {
    const { times } = simulate(1 << 20, 1 << 20, 30, 8, (paths) => paths / 5000);
    expect(Math.max(...times.slice(5))).toBeLessThan(45);
  });

  it('backs off when the work suddenly becomes a thousand times dearer', () => {
    const { times } = simulate(1 << 18, 1 << 20, 30, 6, (paths, turn) => (turn < 4 ? paths / 100_000 : paths / 100));
    const dear = times.slice(8);
    expect(Math.max(...dear)).toBeLessThan(60);
  });

  it('grows from wherever it is, also where whole bands leave some of what is allowed unused', () => {
    for (const start of [130_000, 180_000, 200_000, 230_000, 260_000]) {
      const scheduler = new Scheduler({ pixels: 512 * 512, capacity: 1 << 22, budgetMs: 30 }, start);
      let last = 0;
      for (let turn = 0; turn < 40; turn++) {
        const batch = scheduler.next(1000) as Batch;
        last = batch.pixelCount * batch.sampleCount;
        scheduler.measured(batch, 1.2 + last / 1e6);
      }
      expect(last).toBe(1 << 22);
    }
  });

  it.each([
    // A golden and a glass ball on a fast GPU, and a perfume bottle: milliseconds whatever the size, and of a sample.
    { fixed: 3.5, sample: 1.45, within: 150 },
    { fixed: 10, sample: 9, within: 900 },
  ])('is soon at large batches where small ones cost nearly as much: $fixed ms', ({ fixed, sample, within }) => {
    const { times } = simulate(512 * 512, 1 << 22, 16, 64, (paths) => fixed + (sample * paths) / (512 * 512));
    expect(times.reduce((sum, time) => sum + time, 0)).toBeLessThan(within);
  });

  it('is soon at large batches after a first one that took far longer than others', () => {
    // The same ball, and 30 ms for the first use of kernels.
    const { times } = simulate(
      512 * 512,
      1 << 22,
      16,
      64,
      (paths, turn) => 3.5 + (1.45 * paths) / (512 * 512) + (turn === 0 ? 30 : 0),
    );
    expect(times.reduce((sum, time) => sum + time, 0)).toBeLessThan(200);
  });

  it('does not hold a whole image to what its most expensive band cost', () => {
    // All that is expensive lies in the first band.
    const scheduler = new Scheduler({ pixels: 1 << 18, capacity: 1 << 22, budgetMs: 16 });
    const sizes: number[] = [];
    for (let turn = 0; turn < 24; turn++) {
      const { pixelOffset, pixelCount, sampleCount } = scheduler.next(1000)!;
      const expensive = Math.max(0, Math.min(pixelCount, (1 << 14) - pixelOffset)) * sampleCount;
      const paths = pixelCount * sampleCount;
      sizes.push(paths);
      scheduler.measured(
        { pixelOffset, pixelCount, sampleOffset: 0, sampleCount },
        paths / 1e6 + (6 * expensive) / (1 << 14),
      );
    }
    // 6 ms of each sample in its first band: 16 ms are two samples.
    expect(sizes.at(-1)).toBeGreaterThanOrEqual(2 << 18);
  });

  it('does not shrink batches for what they cost whatever their size', () => {
    // 40 ms of launches for a budget of 30.
    const { batches } = simulate(1 << 14, 1 << 22, 30, 3000, (paths) => 40 + paths / 50_000);
    const sizes = batches.map((b) => b.pixelCount * b.sampleCount);
    // 120 ms in all leave 80 for paths.
    expect(sizes.at(-2)).toBeGreaterThan(1_000_000);
  });

  it('traces samples together where the ends of long paths cost more than a sample', () => {
    // Milliseconds of a perfume bottle on a fast GPU: 10 whatever the size, and 9 a sample.
    const pixels = 512 * 512;
    const { times } = simulate(pixels, 1 << 22, 16, 256, (paths) => 10 + (9 * paths) / pixels);
    expect(times.reduce((sum, time) => sum + time, 0) / 256).toBeLessThan(14);
    expect(Math.max(...times)).toBeLessThanOrEqual(3 * 16);
    // Where launching costs little, submissions keep to their budget.
    const plain = simulate(pixels, 1 << 22, 16, 256, (paths) => 1 + (3 * paths) / pixels).times;
    expect(Math.max(...plain)).toBeLessThanOrEqual(16);
    // In between, and with times that vary by a tenth: no longer than six times that part, but for what is tolerated.
    for (const fixed of [3, 5, 8]) {
      const noisy = (turn: number) => 1 + 0.1 * Math.sin(7.3 * turn);
      const { times: varied } = simulate(
        pixels,
        1 << 22,
        16,
        256,
        (paths, turn) => (fixed + (5 * paths) / pixels) * noisy(turn),
      );
      expect(Math.max(...varied)).toBeLessThanOrEqual(1.5 * 1.1 * Math.max(16, 6 * fixed));
    }
  });

  it('does not take the rest of an image for its sky', () => {
    // Bands of rows: the upper half costs a tenth of the lower one.
    const scheduler = new Scheduler({ pixels: 256 * 256, capacity: 1 << 20, budgetMs: 16 });
    const cost = ({ pixelOffset, pixelCount, sampleCount }: Batch) => {
      const upper = Math.max(0, Math.min(pixelOffset + pixelCount, 32768) - pixelOffset);
      return 1 + sampleCount * (upper * 2e-4 + (pixelCount - upper) * 2e-3);
    };
    const times: number[] = [];
    for (let i = 0; i < 200; i++) {
      const batch = scheduler.next(1000) as Batch;
      times.push(cost(batch));
      scheduler.measured(batch, times.at(-1)!);
    }
    // Once it has seen the image; without a memory every change from sky to ground takes several times the budget.
    expect(Math.max(...times.slice(40))).toBeLessThan(2 * 16);
    // And it does not crawl: half of the budget is used on the whole.
    expect(times.slice(40).reduce((sum, time) => sum + time, 0) / 160).toBeGreaterThan(0.35 * 16);
  });

  it('grows to the capacity on a fast GPU', () => {
    const { batches } = simulate(1 << 16, 1 << 20, 30, 200, () => 0.5);
    expect(Math.max(...batches.map((b) => b.pixelCount * b.sampleCount))).toBe(1 << 20);
  });

  it('learns nothing about large batches from a preview of few pixels', () => {
    // Frames of 80 × 45 pixels that take about their budget, each a film of its own; then the whole image.
    const speed = 3600 / 34;
    let paths: number | undefined;
    for (let frame = 0; frame < 40; frame++) {
      const scheduler = new Scheduler({ pixels: 3600, capacity: 1 << 20, budgetMs: 30 }, paths);
      scheduler.measured(scheduler.next(1) as Batch, 3600 / speed);
      paths = scheduler.paths;
    }
    const whole = new Scheduler({ pixels: 640 * 360, capacity: 1 << 20, budgetMs: 16 }, paths);
    const { pixelCount, sampleCount } = whole.next(100) as Batch;
    expect((pixelCount * sampleCount) / speed).toBeLessThan(200);
  });
});

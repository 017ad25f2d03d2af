import { describe, expect, it } from 'vitest';
import { previewWeight } from '../src/crossfade';
import { DIVISORS, PreviewController } from '../src/preview';

/** Drives a controller by a GPU that needs `fixed` ms a frame and `nanoseconds` a path. */
function settled(fixed: number, nanoseconds: number, pixels: number, budget = 12, saving = false) {
  const controller = new PreviewController(budget);
  let plan = controller.plan(pixels, saving);
  let worst = 0;
  for (let i = 0; i < 120; i++) {
    plan = controller.plan(pixels, saving);
    const paths = (pixels / plan.divisor ** 2) * plan.samples;
    const milliseconds = fixed + (paths * nanoseconds) / 1e6;
    if (i > 10) worst = Math.max(worst, milliseconds);
    controller.measured(pixels / plan.divisor ** 2, plan.samples, milliseconds);
  }
  return { plan, worst };
}

describe('PreviewController', () => {
  it.each([
    [0.3, 0.3, 1280 * 720],
    [1, 5, 1280 * 720],
    [1, 5, 3840 * 1080],
    [3, 40, 1280 * 720],
    [2, 1000, 640 * 360],
  ])('keeps to its budget: %d ms a frame, %d ns a path, %d pixels', (fixed, nanoseconds, pixels) => {
    const { plan, worst } = settled(fixed, nanoseconds, pixels);
    const smallest = fixed + ((pixels / 64) * nanoseconds) / 1e6;
    // Coarse ones may take two and a half times as long.
    const allowed = plan.divisor >= 4 ? 30 : 12;
    expect(worst).toBeLessThanOrEqual(Math.max(allowed, smallest) * 1.01);
    // And wastes none of it: the next larger step would not fit.
    const larger = DIVISORS[DIVISORS.indexOf(plan.divisor as 1) - 1];
    if (larger)
      expect(fixed + (pixels / larger ** 2) * (nanoseconds / 1e6)).toBeGreaterThan(0.75 * (larger >= 4 ? 30 : 12));
  });

  it('keeps to half of it where energy is saved', () => {
    const { plan, worst } = settled(0.3, 3, 1280 * 720, 12, true);
    expect(worst).toBeGreaterThan(0.3);
    expect(worst).toBeLessThanOrEqual(6);
    expect(settled(0.3, 3, 1280 * 720).worst).toBeGreaterThan(6);
    expect(plan).toEqual(settled(0.3, 3, 1280 * 720, 6).plan);
  });

  it('shows the whole image where the GPU is fast, with several samples', () => {
    expect(settled(0.3, 0.3, 1280 * 720).plan).toEqual({ divisor: 1, samples: 8 });
  });

  it('shrinks at once when frames take longer', () => {
    const controller = new PreviewController(12);
    for (let i = 0; i < 40; i++) controller.measured(921600 / controller.plan(921600).divisor ** 2, 1, 3);
    expect(controller.plan(921600).divisor).toBe(1);
    for (let i = 0; i < 6; i++) controller.measured(921600, 1, 60);
    expect(controller.plan(921600).divisor).toBeGreaterThan(1.9);
  });
});

describe('previewWeight', () => {
  it('begins with the preview, ends without it, and never jumps', () => {
    const weights = Array.from({ length: 257 }, (_, samples) => previewWeight(samples, 16, 256));
    expect(weights[0]).toBe(1);
    weights.forEach((weight, i) => i > 0 && expect(weight).toBeLessThanOrEqual(weights[i - 1] as number));
    expect(weights.findIndex((weight) => weight === 0)).toBe(32);
    // The last steps change the image by less than a hundredth of what the two differ.
    expect(weights[30]! - weights[31]!).toBeLessThan(1 / 100);
  });

  it('is gone by half of a short render', () => {
    expect(previewWeight(4, 4, 8)).toBe(0);
    expect(previewWeight(1, 4, 1)).toBe(0);
  });
});

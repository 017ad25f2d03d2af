import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import type { TemporalFilterOptions } from '../src/temporal/index';
import { numbersFrom } from './random-network';
import { HEIGHT, red, runShots, spread, wall, type Seen, type Shot } from './temporal-shots';

afterEach(() => expectNoGpuErrors());

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});

const run = (shots: readonly Shot[], options?: TemporalFilterOptions) => runShots(device, shots, options);

describe('antialiasing', () => {
  it('smooths edges over frames', async () => {
    // The edge between two walls lies within pixels of column 20, whose samples fall to either side alternately.
    const edge = (frame: number) => (x: number, y: number) => {
      const right = x > 20 || (x === 20 && frame % 2 === 0);
      return { ...wall(x, y), radiance: right ? 1 : 0.2, albedo: right ? 1 : 0.2, instance: right ? 1 : 2 };
    };
    const frames = Array.from({ length: 24 }, (_, k) => ({ scene: edge(k), step: 'moves' as const }));
    const { image } = await run(frames);
    const step = await run(frames, { antialias: false });
    // The image before counts for 4 samples: a and b of 0.8 a + 0.2 = b and 0.8 b + 0.04 = a, whose mean is 0.6.
    const mean = (red(image, 20, 12) + red((await run(frames.slice(0, -1))).image, 20, 12)) / 2;
    expect(red(image, 20, 12)).toBeCloseTo(0.5556, 2);
    expect(mean).toBeCloseTo(0.6, 2);
    expect(red(step.image, 20, 12)).toBeCloseTo(0.2, 2);
    for (const { image: one } of [{ image }, step]) {
      expect(red(one, 10, 12)).toBeCloseTo(0.2, 3);
      expect(red(one, 30, 12)).toBeCloseTo(1, 3);
    }
  });

  it('smooths textures finer than pixels over frames', async () => {
    // Samples of a pixel fall on a dark and on a bright texel in turn, neighbours the other way round.
    const texture = (frame: number) => (x: number, y: number) => {
      const albedo = (x + y + frame) % 2 === 0 ? 1 : 0.2;
      return { ...wall(x, y), albedo, radiance: 0.5 * albedo };
    };
    const frames = Array.from({ length: 12 }, (_, k) => ({ scene: texture(k), step: 'moves' as const }));
    const contrast = async (antialias: boolean) => spread((await run(frames, { antialias })).image, 0.3);
    expect(await contrast(false)).toBeCloseTo(0.2, 2);
    // a and b of (a + 1) / 2 = b and (b + 0.2) / 2 = a: a third of the difference is left.
    expect(await contrast(true)).toBeCloseTo(0.2 / 3, 2);
  });

  it('leaves edges of several samples a pixel as smooth as they are', async () => {
    // A column of pixels, of which half shows a bright instance, and half a dim one.
    const EDGE = 20;
    const halves = (x: number, y: number): Seen => ({
      ...wall(x, y),
      instance: x < EDGE ? 4 : 3,
      radiance: x < EDGE ? 4 : 0.5,
    });
    const random = numbersFrom(3);
    const noisy = (x: number, y: number) =>
      (x === EDGE ? 2.25 : halves(x, y).radiance) * (1 + 0.1 * Math.sqrt(12) * (random() - 0.5));
    const shot: Shot = { scene: halves, step: 'cuts', samples: 4, color: noisy };
    const { image, films } = await run([shot], { settledSamples: Infinity });
    for (let y = 4; y < HEIGHT - 4; y++) {
      expect(red(image, EDGE, y)).toBeCloseTo(red(films[0]!, EDGE, y), 5);
      expect(red(image, EDGE + 2, y)).toBeCloseTo(0.5, 1);
    }
  });
});

import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { TemporalFilter, type FrameStep, type TemporalFilterOptions } from '../src/temporal/index';
import {
  HEIGHT,
  MEAN_ALONE,
  PIXELS,
  WIDTH,
  center,
  red,
  runShots,
  spread,
  wall,
  type Seen,
  type Shot,
} from './temporal-shots';

afterEach(() => expectNoGpuErrors());

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});

const run = (shots: readonly Shot[], options?: TemporalFilterOptions) => runShots(device, shots, options);

describe('TemporalFilter', () => {
  it('averages frames by their samples where nothing moves', async () => {
    const counts = [1, 3, 2, 4];
    const shots = counts.map((samples) => ({ scene: wall, step: 'moves' as const, samples, noise: 0.4 }));
    const { image, films } = await run(shots, MEAN_ALONE);
    for (const i of [0, 5 * WIDTH + 7, PIXELS - 1]) {
      const expected = films.reduce((sum, film, k) => sum + counts[k]! * film[4 * i]!, 0) / 10;
      expect(image[4 * i]).toBeCloseTo(expected, 5);
      expect(image[4 * i + 3]).toBe(0.25);
    }
  });

  it('counts the samples of a film that goes on once', async () => {
    const still = { scene: wall, noise: 0.4 };
    const { image, films } = await run(
      [
        { ...still, step: 'moves', samples: 2 },
        { ...still, step: 'moves', samples: 1 },
        { ...still, step: 'continues', samples: 6 },
      ],
      MEAN_ALONE,
    );
    const at = 4 * (9 * WIDTH + 11);
    expect(image[at]).toBeCloseTo((2 * films[0]![at]! + 6 * films[2]![at]!) / 8, 5);
  });

  it('follows surfaces by their motion, between pixels too', async () => {
    // The wall moves to the right; its radiance is a ramp, which interpolation keeps.
    const ramp = (by: number) => (x: number, y: number) => ({
      ...wall(x, y),
      radiance: 0.2 + 0.01 * (x - by),
      position: [0.01 * (x - by), -0.01 * y, -2] as const,
      motion: [-2.5, 0] as const,
    });
    const { image } = await run(
      [0, 2.5, 5, 7.5].map((by) => ({ scene: ramp(by), step: 'moves' as const })),
      MEAN_ALONE,
    );
    // Beyond the left border there was nothing.
    for (let x = 12; x < WIDTH; x++) expect(red(image, x, 12)).toBeCloseTo(0.2 + 0.01 * (x - 7.5), 5);
  });

  it.each([
    ['another instance', { instance: 4 }],
    ['another plane', { position: [0, 0, -2.1] as const }],
    ['another side', { normal: [1, 0, 0] as const }],
  ] as const)('keeps nothing of %s', async (_, change) => {
    const other = (x: number, y: number) => ({ ...wall(x, y), ...change, radiance: 4 });
    const { image } = await run(
      [
        { scene: other, step: 'cuts' },
        { scene: wall, step: 'moves' },
      ],
      MEAN_ALONE,
    );
    expect(spread(image, 0.5)).toBeLessThan(1e-6);
  });

  it('keeps the history of surfaces that face anywhere', async () => {
    const normals = [
      [0, 1, 0],
      [0, -1, 0],
      [1, 0, 0],
      [-1, 0, 0],
      [0, 0, -1],
      [0.6, 0, 0.8],
      [0.6, -1e-5, 0.8],
      [-0.6, 1e-5, -0.8],
      [0.6, -3e-3, 0.8],
    ] as const;
    // Each column faces elsewhere.
    const scene = (x: number, y: number) => ({ ...wall(x, y), normal: normals[x % normals.length]! });
    const { image } = await run(
      [
        { scene, step: 'cuts', color: () => 1 },
        { scene, step: 'moves', color: () => 0 },
      ],
      MEAN_ALONE,
    );
    for (let x = 0; x < WIDTH; x++) expect(red(image, x, 12), String(normals[x % normals.length])).toBeCloseTo(0.5, 5);
  });

  it('keeps the history of an instance that has moved off its plane, where it is said that instances have', async () => {
    const near = (x: number, y: number) => ({ ...wall(x, y), position: [0.01 * x, -0.01 * y, -1.8] as const });
    const shots = (instancesMoved: boolean): Shot[] => [
      { scene: wall, step: 'cuts', color: () => 0.7 },
      { scene: near, step: 'moves', instancesMoved, color: () => 0.5 },
    ];
    expect(spread((await run(shots(true), MEAN_ALONE)).image, 0.6)).toBeLessThan(1e-6);
    expect(spread((await run(shots(false), MEAN_ALONE)).image, 0.5)).toBeLessThan(1e-6);
  });

  it('starts again after a cut', async () => {
    const { image } = await run(
      [
        { scene: wall, step: 'moves', color: () => 4 },
        { scene: wall, step: 'cuts' },
      ],
      MEAN_ALONE,
    );
    expect(spread(image, 0.5)).toBeLessThan(1e-6);
  });

  it('has forgotten a light that went out within five frames', async () => {
    const lit = Array.from({ length: 12 }, () => ({ scene: wall, step: 'moves' as const, noise: 0.3 }));
    const dark = (x: number, y: number) => ({ ...wall(x, y), radiance: 0.05 });
    const off = Array.from({ length: 5 }, () => ({ scene: dark, step: 'moves' as const, noise: 0.3 }));
    const { image } = await run([...lit, ...off]);
    expect(spread(image, 0.05)).toBeLessThan(0.01);
    // Without the bounds on the history it would still be there.
    const kept = await run([...lit, ...off], { clampSigmas: Infinity, maxHistory: 32 });
    expect(spread(kept.image, 0.05)).toBeGreaterThan(0.1);
  });

  it('counts what is seen in mirrors for a few samples only', async () => {
    const mirror = (x: number, y: number) => ({ ...wall(x, y), virtualDepth: 5 });
    const shots = (scene: Shot['scene']): Shot[] => [
      { scene, step: 'cuts', samples: 16, color: () => 1 },
      { scene, step: 'moves', samples: 4, color: () => 0 },
    ];
    expect(spread((await run(shots(mirror), MEAN_ALONE)).image, 0.5)).toBeLessThan(1e-6);
    expect(spread((await run(shots(wall), MEAN_ALONE)).image, 0.8)).toBeLessThan(1e-6);
  });

  describe('with projections', () => {
    type Eyes = readonly [now: number, before: number];
    /** A mirror at z = −2 that shows a ramp at z = −5, from an eye at (x, 0, 0) which both move with. */
    const seenFrom = (eye: number, deep = 2.5) => {
      const scene = (x: number, y: number): Seen => {
        const [dx, dy] = [0.01 * (x - WIDTH / 2), -0.01 * (y - HEIGHT / 2)];
        return {
          ...wall(x, y),
          position: [eye + dx, dy, -2],
          // The depth that run() gives is that of the mirror's plane.
          virtualDepth: 2 + (deep - 1) * Math.hypot(dx, dy, 2),
          radiance: 0.2 + 0.1 * (eye + 2.5 * dx),
          roughness: 1,
        };
      };
      return scene;
    };
    const projection = (eye: number) => {
      const [focalX, focalY] = [400 / WIDTH, 400 / HEIGHT];
      return [focalX, 0, 0, 0, 0, focalY, 0, 0, 0, 0, 0, -1, -focalX * eye, 0, 0, 0];
    };
    const views = ([now, before]: Eyes): Pick<Shot, 'eyes' | 'projections'> => ({
      eyes: [
        [now, 0, 0],
        [before, 0, 0],
      ],
      projections: [projection(now), projection(before)],
    });

    it('follows what is seen in mirrors to where its virtual image was', async () => {
      const step = 0.0625;
      const shots = [0, 1, 2, 3].map((k): Shot => ({
        scene: seenFrom(k * step),
        step: 'moves',
        ...views([k * step, (k - 1) * step]),
      }));
      const { image } = await run(shots, MEAN_ALONE);
      const expected = (x: number) => seenFrom(3 * step)(x, 12).radiance;
      // The virtual image moves by 2.5 pixels a frame, in three steps from the right, beyond whose border is nothing.
      for (let x = 0; x < WIDTH - 10; x++) expect(red(image, x, 12)).toBeCloseTo(expected(x), 5);
      // The mirror moves by 6.25.
      const motion = [6.25, 0] as const;
      const surface = shots.map(({ scene, ...shot }) => ({
        ...shot,
        projections: undefined,
        scene: (x: number, y: number) => ({ ...scene(x, y), motion }),
      }));
      expect(Math.abs(red((await run(surface, MEAN_ALONE)).image, 8, 12) - expected(8))).toBeGreaterThan(0.005);
    });

    it('counts its history in full, but not that of something nearer or farther, nor after instances have moved', async () => {
      const shots = (deep: number, instancesMoved = false): Shot[] => [
        { scene: seenFrom(0, deep), step: 'cuts', samples: 16, color: () => 1 },
        { scene: seenFrom(0), step: 'moves', samples: 4, color: () => 0, instancesMoved, ...views([0, 0]) },
      ];
      expect(spread((await run(shots(2.5), MEAN_ALONE)).image, 0.8)).toBeLessThan(1e-6);
      expect(spread((await run(shots(2.55), MEAN_ALONE)).image, 0.8)).toBeLessThan(1e-6);
      for (const deep of [2.4, 2.6]) expect(spread((await run(shots(deep), MEAN_ALONE)).image, 0)).toBeLessThan(1e-6);
      expect(spread((await run(shots(2.5, true), MEAN_ALONE)).image, 0.5)).toBeLessThan(1e-6);
    });
  });

  it.each([
    // The view turns by 0.1: half a share of change over the history allows 5 samples of α = 1/2, 1/2 sample of α = 1/11.
    ['diffuse', 1, 16],
    ['α 1/2', Math.SQRT1_2, 5],
    ['α 1/11', Math.sqrt(1 / 11), 0.5],
  ])('keeps as much of the history of reflections as the view has not changed: %s', async (_, roughness, kept) => {
    const scene = () => ({ ...wall(0, 0), roughness });
    const from = (x: number): readonly [number, number, number] => [x, 0, 0];
    const shots: Shot[] = [
      { scene, step: 'cuts', samples: 16, color: () => 1 },
      { scene, step: 'moves', samples: 1, color: () => 0, eyes: [from(0), from(2 * Math.tan(2 * Math.asin(0.05)))] },
    ];
    const options = { ...MEAN_ALONE, maxHistory: 16 };
    expect(spread((await run(shots, options)).image, kept / (kept + 1))).toBeLessThan(0.005);
    // What is seen from the same place has not changed.
    const still = [shots[0]!, { ...shots[1]!, eyes: undefined }];
    expect(spread((await run(still, options)).image, 16 / 17)).toBeLessThan(1e-5);
  });

  it('leaves what smooth surfaces mirror, where it takes the noise of rough ones', async () => {
    // A surface that bends: normals turn by 0.02 from pixel to pixel, mirrored directions by twice as much.
    const bent = (roughness: number) => (x: number, y: number) => {
      const angle = 0.02 * (x - WIDTH / 2);
      return { ...wall(x, y), roughness, normal: [Math.sin(angle), 0, Math.cos(angle)] as const };
    };
    // Stripes of what is mirrored; in a first frame nothing else tells them from noise.
    const stripes = (x: number) => (x % 4 < 2 ? 0.2 : 0.8);
    const contrast = async (roughness: number) => {
      const shot: Shot = { scene: bent(roughness), step: 'cuts', color: stripes };
      const { image } = await run([shot], { antialias: false });
      return spread(image, 0.5) / 0.3;
    };
    expect(await contrast(1)).toBeLessThan(0.4);
    expect(await contrast(0.15)).toBeGreaterThan(0.99);
  });

  it('takes noise from surfaces and leaves their edges and textures', async () => {
    // Left a wall, right another one that faces elsewhere and is brighter; stripes of albedo on both.
    const corner = (x: number, y: number): Seen => {
      const right = x >= WIDTH / 2;
      const albedo = y % 4 < 2 ? 0.2 : 0.8;
      return {
        ...wall(x, y),
        albedo,
        radiance: albedo * (right ? 2 : 1),
        normal: right ? [-0.8, 0, 0.6] : [0, 0, 1],
        position: [0.01 * x, -0.01 * y, right ? -2 + (0.008 * (x - WIDTH / 2)) / 0.6 : -2],
        virtualDepth: 2,
      };
    };
    const expected = Array.from({ length: PIXELS }, (_, i) => corner(...center(i)).radiance);
    const error = (image: Float32Array) =>
      Math.sqrt(expected.reduce((sum, value, i) => sum + (image[4 * i]! / value - 1) ** 2, 0) / PIXELS);
    const { image, films } = await run([{ scene: corner, step: 'cuts', noise: 0.3 }]);
    expect(error(films[0]!)).toBeGreaterThan(0.25);
    expect(error(image)).toBeLessThan(0.06);
    // Over frames it becomes less still.
    const frames = Array.from({ length: 8 }, () => ({ scene: corner, step: 'moves' as const, noise: 0.3 }));
    expect(error((await run(frames)).image)).toBeLessThan(0.03);
  });

  it('keeps a light apart from the surface around it, and filters across instances that are lit alike', async () => {
    const inside = (x: number, y: number) => x >= 14 && x < 26 && y >= 10 && y < 14;
    const lit = (radiance: number) => (x: number, y: number) =>
      inside(x, y) ? { ...wall(x, y), instance: 4, radiance } : wall(x, y);
    const frames = (radiance: number) =>
      Array.from({ length: 6 }, (): Shot => ({ scene: lit(radiance), step: 'moves', noise: 0.6 }));
    const around = (image: Float32Array, reach: number) => {
      let off = 0;
      for (let y = 10 - reach; y < 14 + reach; y++)
        for (let x = 14 - reach; x < 26 + reach; x++)
          if (!inside(x, y)) off = Math.max(off, Math.abs(red(image, x, y) / 0.5 - 1));
      return off;
    };
    expect(around((await run(frames(10))).image, 4)).toBeLessThan(0.25);
    // A patch of another instance that is lit as what is around it has no more noise than that.
    const { image } = await run(frames(0.5));
    let off = 0;
    for (let x = 14; x < 26; x++)
      for (let y = 10; y < 14; y++) off = Math.max(off, Math.abs(red(image, x, y) / 0.5 - 1));
    expect(off).toBeLessThan(0.15);
  });

  it('filters in space as long as the history leaves noise', async () => {
    const frames = Array.from({ length: 40 }, () => ({ scene: wall, step: 'moves' as const, noise: 0.5 }));
    const options = { antialias: false, maxHistory: 2 };
    const [both, mean] = [await run(frames, options), await run(frames, { ...options, passes: 0 })];
    expect(spread(both.image, 0.5) / spread(mean.image, 0.5)).toBeLessThan(0.08);
  });

  it('changes nothing where there is no noise', async () => {
    const smooth = (x: number, y: number) => ({ ...wall(x, y), radiance: 0.3 + 0.002 * x });
    // The first frames do not know yet that what varies is no noise.
    const frames = Array.from({ length: 32 }, () => ({ scene: smooth, step: 'moves' as const }));
    const { image } = await run(frames);
    for (let x = 0; x < WIDTH; x++) expect(red(image, x, 10)).toBeCloseTo(0.3 + 0.002 * x, 3);
  });

  it('leaves what is behind all surfaces as it is', async () => {
    const sky = (x: number, y: number): Seen => ({
      ...wall(x, y),
      radiance: x % 3 === 0 ? 1 : 0.2,
      albedo: 0,
      instance: 0xffffffff,
      position: [0, 0, 0],
      virtualDepth: 0,
    });
    const frames = Array.from({ length: 4 }, () => ({ scene: sky, step: 'moves' as const }));
    const { image, films } = await run(frames);
    // Divided by the albedo and multiplied again.
    image.forEach((value, i) => expect(value).toBeCloseTo(films.at(-1)![i]!, 6));
  });

  it('comes to the film, bit for bit', async () => {
    const shot = (step: FrameStep, samples: number) => ({ scene: wall, step, samples, noise: 0.3 });
    const { image, films } = await run([shot('moves', 1), shot('continues', 64)]);
    expect(image).toEqual(films[1]);
    const half = await run([shot('moves', 1), shot('continues', 16)]);
    expect(half.image).not.toEqual(half.films[1]);
    expect(spread(half.image, 0.5)).toBeLessThan(spread(half.films[1]!, 0.5));
  });

  it('keeps broken pixels out of the history and away from their neighbours', async () => {
    const broken = (value: number) => (x: number, y: number) => (x === 12 && y === 9 ? value : 0.5);
    for (const value of [NaN, Infinity, -1]) {
      const { image } = await run([
        { scene: wall, step: 'moves', color: broken(value) },
        { scene: wall, step: 'moves', color: () => 0.5 },
      ]);
      expect(image.every(Number.isFinite)).toBe(true);
      expect(Math.abs(red(image, 16, 9) - 0.5)).toBeLessThan(0.02);
    }
  });

  it('takes an eye on a surface', async () => {
    const eye = wall(10, 10).position;
    const shot = { scene: wall, noise: 0.3, eyes: [eye, eye] as const };
    const { image } = await run([
      { ...shot, step: 'cuts' },
      { ...shot, step: 'moves' },
    ]);
    expect(image.every(Number.isFinite)).toBe(true);
  });

  it('says what is wrong', async () => {
    const bad = (options: TemporalFilterOptions) => TemporalFilter.create(device, options);
    await expect(bad({ passes: 6 })).rejects.toMatchObject({ code: 'denoise/option' });
    await expect(bad({ maxHistory: 0 })).rejects.toMatchObject({ code: 'denoise/option' });
    await expect(bad({ clampSigmas: 0 })).rejects.toMatchObject({ code: 'denoise/option' });
    await expect(bad({ settledSamples: 4 })).rejects.toMatchObject({ code: 'denoise/option' });
    await expect(bad({ signal: AbortSignal.abort(new Error('enough')) })).rejects.toThrow('enough');
    const filter = await TemporalFilter.create(device);
    const data = device.createBuffer({ size: 16 * 16, usage: GPUBufferUsage.STORAGE });
    const frame = { color: data, albedo: data, normal: data, position: data, ids: data, motion: data };
    const call = (size: number, samples = 1) =>
      filter.filter({ ...frame, width: size, height: size, samples, step: 'cuts' });
    expect(() => call(4)).toThrow(expect.objectContaining({ code: 'denoise/size' }));
    await filter.prepare(5, 5);
    // Beside the uniforms.
    expect(filter.memoryBytes - 6 * 256).toBe(224 * 25);
    expect(() => call(5)).toThrow(expect.objectContaining({ code: 'denoise/input' }));
    await filter.prepare(4, 4);
    expect(() => call(4, 0)).toThrow(expect.objectContaining({ code: 'denoise/input' }));
    expect(() => filter.filterTracer({ aovs: ['albedo'] } as never, 'cuts')).toThrow('setAovs');
    filter.destroy();
    expect(() => call(4)).toThrow(expect.objectContaining({ code: 'denoise/destroyed' }));
    expect(filter.memoryBytes).toBe(0);
    data.destroy();
  });
});

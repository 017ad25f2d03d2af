import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions, type RenderOptions, type RenderProgress } from '../../src/index';
import { samplesOf } from '../full';
import { addQuad, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

/** Tiles of 8 × 8 pixels in a row, and the image's side: 9 tiles, with `npm test -- --full` 16. */
const TILES = process.env['GLANZ_FULL'] === undefined ? 3 : 4;
const SIZE = 8 * TILES;
/** For comparisons bit by bit: a tile of each kind, twice. */
const SMALL = { width: 16, height: 16 };

/** Left a wall that glows evenly, right a floor with soft shadows. */
function scene() {
  const made = createScene();
  addQuad(made, 3, 0, lambert(0.7));
  addQuad(
    made,
    1,
    0.05,
    { name: 'glow', parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 0.4 } },
    { transform: [1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, -1.2, 0, 0, 1] },
  );
  addQuad(made, 0.15, 0.5, lambert(0.2), { transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.6, 0.2, 0, 1] });
  addQuad(
    made,
    0.5,
    1.5,
    { name: 'light', parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 4 } },
    { flip: true, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1.1, 0.3, 0, 1] },
  );
  made.environment = { type: 'constant', radiance: [0.1, 0.2, 0.3] };
  return made;
}

async function start(options: Partial<PathTracerOptions> = {}): Promise<PathTracer> {
  return PathTracer.create(device, scene(), {
    width: SIZE,
    height: SIZE,
    camera,
    maxDepth: 3,
    pathsInFlight: 1 << 14,
    ...options,
  });
}

async function run(tracer: PathTracer, options: RenderOptions): Promise<RenderProgress[]> {
  const seen: RenderProgress[] = [];
  for await (const progress of tracer.render({ maxSubmitMs: 1000, ...options })) seen.push(progress);
  return seen;
}

const same = (a: Float32Array, b: Float32Array) =>
  a.length === b.length && a.every((value, i) => Object.is(value, b[i]));
const NOISE = 0.02;

let better: Promise<Float32Array> | undefined;
/** Another image of the scene, of much less noise: with four times the samples, as with --full, errors differ by 1.5 %. */
function reference(): Promise<Float32Array> {
  better ??= (async () => {
    const tracer = await start({ seed: 99 });
    await run(tracer, { samples: samplesOf(1024, 4) });
    const image = await tracer.read('beauty');
    tracer.destroy();
    return image;
  })();
  return better;
}

describe('adaptive sampling', () => {
  it('stops where and when the image is as good as was asked for', async () => {
    const tracer = await start();
    const seen = await run(tracer, { noise: NOISE });
    const last = seen.at(-1) as RenderProgress;
    expect(last.noise).toBeGreaterThan(0.2 * NOISE);
    expect(last.noise).toBeLessThanOrEqual(NOISE);
    expect(last).toMatchObject({ remainingMs: 0, active: 0 });
    expect(seen[0]).toMatchObject({ remainingMs: Infinity, active: 1 });
    expect(seen.some(({ active }) => active > 0 && active < 0.8)).toBe(true);
    // Samples went where the noise is.
    const variance = await tracer.read('variance');
    const samplesAt = (x: number, y: number) => variance[4 * (y * SIZE + x) + 3] as number;
    expect(samplesAt(1, SIZE / 2)).toBe(64);
    expect(samplesAt(SIZE - 8, SIZE / 2 - 2)).toBeGreaterThan(64);
    expect(tracer.samples).toBe(Math.max(...variance.filter((_, i) => i % 4 === 3)));

    // The error against another, much better image is what the estimate says, tile by tile.
    const [ours, truth] = [await tracer.read('beauty'), await reference()];
    const meanSquare =
      truth.reduce((sum, value, i) => (i % 4 === 3 ? sum : sum + (value * value) / 3), 0) / (SIZE * SIZE);
    let whole = 0;
    for (let tile = 0; tile < TILES * TILES; tile++) {
      let error = 0;
      let bright = 0;
      for (let p = 0; p < 64; p++) {
        const i = 4 * ((Math.floor(tile / TILES) * 8 + Math.floor(p / 8)) * SIZE + (tile % TILES) * 8 + (p % 8));
        for (let c = 0; c < 3; c++) {
          error += ((ours[i + c] as number) - (truth[i + c] as number)) ** 2 / 3;
          bright += (truth[i + c] as number) ** 2 / 3;
        }
      }
      const relative = Math.sqrt(error / (bright + 0.01 * meanSquare * 64));
      // 192 numbers: their root mean square is known to some 7 %, and errs on the safe side for Sobol points.
      expect(relative).toBeLessThan(1.2 * NOISE);
      whole += (relative * relative) / (TILES * TILES);
    }
    expect(Math.sqrt(whole) / (last.noise as number)).toBeGreaterThan(0.4);
    expect(Math.sqrt(whole) / (last.noise as number)).toBeLessThan(1.15);
    tracer.destroy();
  });

  it('the same image whatever the batches and interruptions', async () => {
    const one = await start(SMALL);
    await run(one, { noise: NOISE });
    const two = await start({ ...SMALL, pathsInFlight: 300 });
    const control = new AbortController();
    for await (const { samples } of two.render({ noise: NOISE, signal: control.signal, maxSubmitMs: 5 }))
      if (samples > 70) control.abort();
    await run(two, { noise: NOISE, maxSubmitMs: 20 });
    expect(two.samples).toBe(one.samples);
    expect(same(await two.read('beauty'), await one.read('beauty'))).toBe(true);
    expect(same(await two.read('variance'), await one.read('variance'))).toBe(true);
    one.destroy();
    two.destroy();
  });

  it('an uneven film can be driven further, and evened out to the image that all samples make', async () => {
    const tracer = await start(SMALL);
    await run(tracer, { noise: 2 * NOISE });
    const before = tracer.samples;
    const [last] = (await run(tracer, { noise: NOISE })).slice(-1);
    expect(last?.noise).toBeLessThanOrEqual(NOISE);
    expect(tracer.samples).toBeGreaterThan(before);
    const even = tracer.samples + 5;
    const seen = await run(tracer, { samples: even });
    expect(seen.every(({ remainingMs }, i) => i === 0 || remainingMs <= 1e7)).toBe(true);
    const plain = await start(SMALL);
    await run(plain, { samples: even });
    expect(same(await tracer.read('beauty'), await plain.read('beauty'))).toBe(true);
    expect((await run(tracer, { samples: even })).length).toBe(0);
    tracer.destroy();
    plain.destroy();
  });

  it('its bias is less than the noise it leaves', async () => {
    const truth = await reference();
    const runs = 12;
    const mean = new Float64Array(truth.length);
    let spread = 0;
    for (let seed = 0; seed < runs; seed++) {
      const tracer = await start({ seed, sampler: 'independent' });
      await run(tracer, { noise: 2 * NOISE });
      (await tracer.read('beauty')).forEach((value, i) => {
        mean[i] = (mean[i] as number) + value / runs;
        spread += (value - (truth[i] as number)) ** 2;
      });
      tracer.destroy();
    }
    // Of the whole image's mean, and per pixel: squared error of the mean over runs, against one run's.
    const sum = (values: ArrayLike<number>) =>
      Array.from(values).reduce((all, value, i) => (i % 4 === 3 ? all : all + value), 0);
    expect(Math.abs(sum(mean) / sum(truth) - 1)).toBeLessThan(0.002);
    const left = mean.reduce((all, value, i) => all + (value - (truth[i] as number)) ** 2, 0);
    // Without bias the mean over 12 runs has a twelfth of one run's squared error.
    expect(left / (spread / runs)).toBeLessThan(1.5 / runs);
  });

  it('ends at the most samples when the target is out of reach, and refuses targets that are none', async () => {
    const tracer = await start();
    const seen = await run(tracer, { noise: 1e-6, samples: 100 });
    expect(tracer.samples).toBe(100);
    expect(seen.at(-1)?.noise).toBeGreaterThan(1e-6);
    await expect(run(tracer, { noise: -1 })).rejects.toMatchObject({ code: 'renderer/samples' });
    tracer.destroy();
  });
});

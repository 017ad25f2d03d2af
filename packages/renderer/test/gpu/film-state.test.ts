import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type FilmState, type PathTracerOptions } from '../../src/index';
import { decodeFilmState, encodeFilmState, mergeFilmStates, readFilmState } from '../../src/film';
import { addQuad, addSphere, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});
afterEach(() => expectNoGpuErrors());

// Larger than a band of the first batches, so that samples are cut in the middle of the image.
const options: PathTracerOptions = { width: 80, height: 60, camera, pathsInFlight: 1 << 11, maxDepth: 3 };

function stage(): Scene {
  const scene = createScene();
  addQuad(scene, 0.9, 0, lambert(0.6, 0.5, 0.4));
  addSphere(
    scene,
    0.3,
    [0, 0, 0.3],
    { name: 'ball', parameters: { base_color: [0.8, 0.2, 0.1], specular_roughness: 0.3 } },
    12,
  );
  scene.lights.push({
    type: 'point',
    name: 'key',
    color: [1, 1, 1],
    intensity: 2,
    position: [-1, 0.5, 1.5],
    light_group: 'key',
  });
  scene.environment = { type: 'constant', radiance: [0.2, 0.3, 0.4] };
  return scene;
}

const make = (changed: Partial<PathTracerOptions> = {}) =>
  PathTracer.create(device, stage(), { ...options, ...changed });

/** Renders until `until` says so after a batch, or to the end. */
async function render(
  tracer: PathTracer,
  goal: { samples: number; noise?: number },
  until?: (samples: number) => boolean,
): Promise<void> {
  for await (const { samples } of tracer.render({ ...goal, maxSubmitMs: 5 })) if (until?.(samples)) return;
}

async function layers(tracer: PathTracer): Promise<Record<string, Float32Array>> {
  return {
    beauty: await tracer.read('beauty'),
    variance: await tracer.read('variance'),
    key: await tracer.readLightGroup('key'),
  };
}

describe('a saved film', () => {
  it('goes on in another tracer, bit for bit as if it had never been interrupted', async () => {
    const whole = await make();
    await render(whole, { samples: 12 });
    const expected = await layers(whole);
    const first = await make();
    await render(first, { samples: 12 }, (samples) => samples >= 7);
    const state = decodeFilmState(encodeFilmState(await first.saveFilm()));
    first.destroy();
    const second = await make({ pathsInFlight: 1 << 10 });
    await second.restoreFilm(state);
    expect(second.samples).toBeGreaterThanOrEqual(7);
    await render(second, { samples: 12 });
    expect(await layers(second)).toEqual(expected);
    whole.destroy();
    second.destroy();
  });

  it('is exact while render() runs, between two bands of one sample', async () => {
    const whole = await make();
    await render(whole, { samples: 12 });
    const expected = await layers(whole);
    const first = await make();
    const states: Promise<FilmState>[] = [];
    const rendering = render(first, { samples: 12 });
    while (states.length < 12) {
      await new Promise((resolve) => setTimeout(resolve, 3));
      states.push(first.saveFilm());
    }
    await rendering;
    const saved = await Promise.all(states);
    // Else this would test what the test above does.
    const cut = saved.find(({ sampling }) => sampling.pixel > 0);
    expect(cut).toBeDefined();
    const second = await make();
    await second.restoreFilm(cut as FilmState);
    await render(second, { samples: 12 });
    expect(await layers(second)).toEqual(expected);
    for (const tracer of [whole, first, second]) tracer.destroy();
  });

  it('goes on towards a noise target with the tiles that were under way', async () => {
    const goal = { samples: 256, noise: 0.02 };
    const small = { width: 40, height: 24 };
    const whole = await make(small);
    await render(whole, goal);
    const expected = await whole.read('variance');
    const first = await make(small);
    let partial: FilmState | undefined;
    for await (const { active } of first.render({ ...goal, maxSubmitMs: 5 })) {
      if (active >= 1) continue;
      partial = await first.saveFilm();
      break;
    }
    expect(partial?.sampling.tiles).toBeDefined();
    const second = await make(small);
    await second.restoreFilm(decodeFilmState(encodeFilmState(partial as FilmState)));
    await render(second, goal);
    expect(await second.read('variance')).toEqual(expected);
    for (const tracer of [whole, first, second]) tracer.destroy();
  });

  it('shows light groups as they are set where it is resumed', async () => {
    const whole = await make({ width: 16, height: 16 });
    await render(whole, { samples: 8 });
    const state = await whole.saveFilm();
    await whole.setLightGroup('key', { intensity: 0.25 });
    const expected = await whole.read('beauty');
    const second = await make({ width: 16, height: 16 });
    await second.setLightGroup('key', { intensity: 0.25 });
    await second.restoreFilm(state);
    expect(await second.read('beauty')).toEqual(expected);
    whole.destroy();
    second.destroy();
  });

  it('is refused where something else is rendered', async () => {
    const small = { width: 8, height: 8 };
    const tracer = await make(small);
    await render(tracer, { samples: 1 });
    const state = await tracer.saveFilm();
    const cases: readonly (readonly [string, () => Promise<PathTracer>])[] = [
      ['× 9', () => make({ width: 8, height: 9 })],
      ['other options', () => make({ ...small, seed: 1 })],
      ['other options', () => make({ ...small, camera: { ...camera, yfov: 0.5 } })],
    ];
    for (const [message, other] of cases) {
      const second = await other();
      await expect(second.restoreFilm(state)).rejects.toMatchObject({
        code: 'renderer/film-state',
        message: expect.stringContaining(message) as string,
      });
      second.destroy();
    }
    const before = await tracer.read('beauty');
    await tracer.setMaterial('ball', { specular_roughness: 0.5 });
    await expect(tracer.restoreFilm(state)).rejects.toMatchObject({ code: 'renderer/film-state' });
    await tracer.setMaterial('ball', { specular_roughness: 0.3 });
    await tracer.restoreFilm(state);
    expect(await tracer.read('beauty')).toEqual(before);
    tracer.destroy();
  });
});

describe('films of different samples', () => {
  const small = { width: 24, height: 16 };
  /** A film of the samples from `first` to `end`. */
  async function range(first: number, end: number, changed: Partial<PathTracerOptions> = {}): Promise<FilmState> {
    const tracer = await make({ ...small, ...changed });
    tracer.reset({ firstSample: first });
    await render(tracer, { samples: end - first });
    expect(tracer.samples).toBe(end - first);
    const state = decodeFilmState(encodeFilmState(await tracer.saveFilm()));
    tracer.destroy();
    return state;
  }

  /** Largest difference of two layers relative to the values, in units of 2⁻²³. */
  const difference = (a: Float32Array, b: Float32Array) =>
    a.reduce((max, value, i) => Math.max(max, Math.abs(value - b[i]!) / Math.max(Math.abs(value), 1e-20)), 0) * 2 ** 23;

  it('merge to what one run gives, in either order, in three parts, and go on from there', async () => {
    const whole = await range(0, 100);
    const [a, b] = [await range(0, 50), await range(50, 100)];
    const merged = mergeFilmStates([a, b]);
    expect(mergeFilmStates([b, a])).toEqual(merged);
    expect([merged.samples, merged.ranges, merged.parts]).toEqual([100, [[0, 100]], []]);
    // (n / 16 + 16) · 2⁻²³: one rounding a chunk, 15 in a chunk that was split, and those of the merge.
    for (const name of ['film_total', 'film_block', 'beauty'] as const)
      expect(difference(whole.sums[name], merged.sums[name]), name).toBeLessThanOrEqual(100 / 16 + 16);
    // The squares of chunk means have twice the error of the means.
    expect(difference(whole.sums.film_moment, merged.sums.film_moment)).toBeLessThanOrEqual(2 * (100 / 16 + 16));
    // The mean of the chunks' variance: the difference of two nearly equal numbers, so compared as a whole.
    const sum = (state: FilmState) =>
      readFilmState(state, 'variance').reduce((all, v, i) => all + (i % 4 < 3 ? v : 0), 0);
    expect(sum(merged) / sum(whole)).toBeCloseTo(1, 3);
    // Parts that leave a gap, and chunks in three pieces.
    const [first, last, middle] = [await range(0, 50), await range(58, 100), await range(50, 58)];
    const gap = mergeFilmStates([last, first]);
    expect([gap.samples, gap.ranges, gap.parts.map(({ chunk }) => chunk)]).toEqual([
      92,
      [
        [0, 50],
        [58, 100],
      ],
      [3],
    ]);
    const closed = mergeFilmStates([decodeFilmState(encodeFilmState(gap)), middle]);
    expect([closed.ranges, closed.parts]).toEqual([[[0, 100]], []]);
    expect(difference(whole.sums.film_total, closed.sums.film_total)).toBeLessThanOrEqual(100 / 16 + 16);
    expect(difference(whole.sums.film_moment, closed.sums.film_moment)).toBeLessThanOrEqual(2 * (100 / 16 + 16));
    // The tracer goes on with the samples 100 to 119, and refuses the film with a gap.
    const tracer = await make(small);
    await tracer.restoreFilm(merged);
    await render(tracer, { samples: 120 });
    expect(difference((await range(0, 120)).sums.beauty, await tracer.read('beauty'))).toBeLessThanOrEqual(
      120 / 16 + 16,
    );
    await expect(tracer.restoreFilm(gap)).rejects.toMatchObject({
      code: 'renderer/film-state',
      message: expect.stringContaining('0–49, 58–99') as string,
    });
    tracer.destroy();
  });

  it('are the same bit for bit where a film of one chunk is appended', async () => {
    const whole = await range(0, 64);
    const merged = mergeFilmStates([await range(48, 64), await range(0, 48)]);
    expect(merged.sums.film_total).toEqual(whole.sums.film_total);
    expect(merged.sums.film_block).toEqual(whole.sums.film_block);
  });

  it('are resumed in the middle of a first chunk and after it, bit for bit', async () => {
    const expected = await range(50, 90);
    for (const stop of [57, 64, 71]) {
      const tracer = await make({ ...small, pathsInFlight: 256 });
      await tracer.restoreFilm(await range(50, stop));
      await render(tracer, { samples: 40 });
      expect({ ...(await tracer.saveFilm()) }, `stopped at ${stop}`).toEqual(expected);
      tracer.destroy();
    }
  });

  it('have the variance of their own chunks, and the numbers that the tracer reads', async () => {
    const tracer = await make(small);
    tracer.reset({ firstSample: 50 });
    await render(tracer, { samples: 46 });
    const state = await tracer.saveFilm();
    // Samples 50 to 95: two whole chunks, from 64 on, are the least that has a variance.
    const variance = await tracer.read('variance');
    expect(variance.every(Number.isFinite)).toBe(true);
    expect(variance[3]).toBe(46);
    expect(readFilmState(state, 'variance')).toEqual(variance);
    const inner = readFilmState(await range(64, 96), 'variance');
    expect(
      variance
        .filter((_, i) => i % 4 < 3)
        .reduce((max, value, i) => Math.max(max, Math.abs(value - inner.filter((_v, k) => k % 4 < 3)[i]!)), 0),
    ).toBeLessThan(1e-6);
    expect(difference(await tracer.read('beauty'), readFilmState(state, 'beauty'))).toBeLessThanOrEqual(4);
    tracer.destroy();
  });

  it('are composed on the CPU as on the GPU with catchers and light groups', async () => {
    const tracer = await make(small);
    await tracer.setCatcher(0, true);
    await tracer.setLightGroup('key', { intensity: 0.5, color: [1, 0.5, 0] });
    const alphas = new Set<number>();
    for (const background of ['environment', 'transparent'] as const) {
      tracer.setBackground(background);
      await render(tracer, { samples: 20 });
      const beauty = await tracer.read('beauty');
      const twin = readFilmState(await tracer.saveFilm(), 'beauty');
      // The shadow is one minus a ratio: an absolute error of a few roundings of values near one.
      beauty.forEach((value, i) => expect(Math.abs(value - twin[i]!)).toBeLessThan(1e-5));
      for (let i = 3; i < beauty.length; i += 4) alphas.add(beauty[i]!);
    }
    // The catcher's shadows are there.
    expect(alphas.size).toBeGreaterThan(20);
    tracer.destroy();
  });

  it('are refused where they do not belong together', async () => {
    const [a, b, other] = [await range(0, 20), await range(10, 30), await range(20, 30, { seed: 7 })];
    const refusal = (message: string) =>
      expect.objectContaining({
        code: 'renderer/film-state',
        message: expect.stringContaining(message) as string,
      }) as Error;
    expect(() => mergeFilmStates([])).toThrow(refusal('there is none'));
    expect(() => mergeFilmStates([a, b])).toThrow(refusal('sample 10'));
    expect(() => mergeFilmStates([a, other])).toThrow(refusal('different scenes'));
    expect(() => mergeFilmStates([a, { ...b, width: 12, height: 32 }])).toThrow(refusal('pixels'));
    expect(() => mergeFilmStates([a, { ...b, sampling: { ...b.sampling, pixel: 3 } }])).toThrow(refusal('middle'));
    const tracer = await make(small);
    for (const firstSample of [-1, 0.5, NaN, 2 ** 31])
      expect(() => tracer.reset({ firstSample })).toThrow(
        expect.objectContaining({ code: 'renderer/samples' }) as Error,
      );
    tracer.reset({ firstSample: 5 });
    await expect(render(tracer, { samples: 64, noise: 0.1 })).rejects.toMatchObject({ code: 'renderer/samples' });
    tracer.destroy();
  });
});

import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { decodeFilmState, encodeFilmState, PathTracer, type FilmState, type PathTracerOptions } from '../../src/index';
import { addQuad, addSphere, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

// Larger than a band of the first batches, so that samples are cut in the middle of the image.
const options: PathTracerOptions = { width: 160, height: 120, camera, pathsInFlight: 1 << 13, maxDepth: 3 };

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
    await render(whole, { samples: 40 });
    const expected = await layers(whole);
    const first = await make();
    await render(first, { samples: 40 }, (samples) => samples >= 19);
    const state = decodeFilmState(encodeFilmState(await first.saveFilm()));
    first.destroy();
    const second = await make({ pathsInFlight: 1 << 12 });
    await second.restoreFilm(state);
    expect(second.samples).toBeGreaterThanOrEqual(19);
    await render(second, { samples: 40 });
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

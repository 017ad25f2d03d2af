import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Camera, Material, Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { renderShutter, type ShutterOptions, shutterTimes } from '../../src/shutter';
import { addQuad, addSphere, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

const at = (x: number, y = 0, z = 0) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1];
const emitter: Material = {
  name: 'emitter',
  parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 1, emission_color: [1, 1, 1] },
};
const dark: Partial<PathTracerOptions> = { background: 'transparent', maxDepth: 1, filter: 'box' };

async function exposed(tracer: PathTracer, options: ShutterOptions): Promise<Float32Array> {
  for await (const _ of renderShutter(tracer, options));
  expect(tracer.samples).toBe(options.samples);
  return tracer.read('beauty');
}

describe('the film of an open shutter', () => {
  it('is that of a render without one where nothing moves, bit for bit', async () => {
    const scene = createScene();
    addQuad(scene, 0.8, 0, lambert(0.5));
    addSphere(scene, 0.4, [0.2, 0.1, 0.3], lambert(0.8), 12);
    scene.environment = { type: 'constant', radiance: [1, 0.9, 0.8] };
    const tracer = await PathTracer.create(device, scene, { width: 24, height: 20, camera, maxDepth: 3 });
    for await (const _ of tracer.render({ samples: 37 }));
    const [still, variance] = [await tracer.read('beauty'), await tracer.read('variance')];
    expect(still.some((value) => value > 0)).toBe(true);
    for (const times of [undefined, 1, 5]) {
      const pose = async () => {
        await tracer.setCamera(camera);
        await tracer.setInstanceTransform(1, at(0));
      };
      expect(await exposed(tracer, { samples: 37, times, pose })).toEqual(still);
      expect(await tracer.read('variance')).toEqual(variance);
    }
    tracer.destroy();
  });

  it('is the mean of films that were rendered at its times: of the camera, an instance, a mesh and a light', async () => {
    const scene = createScene();
    addQuad(scene, 0.8, 0, lambert(0.5));
    addSphere(scene, 0.3, [0, 0, 0.3], lambert(0.8, 0.2, 0.2), 12);
    scene.lights.push({ type: 'point', name: 'key', color: [1, 1, 1], intensity: 3, position: [-1, 0.5, 1.5] });
    scene.environment = { type: 'constant', radiance: [0.2, 0.3, 0.4] };
    const options: PathTracerOptions = { width: 24, height: 20, camera, maxDepth: 3 };
    const flat = scene.meshes[0] as Scene['meshes'][number];
    const pose = async (tracer: PathTracer, time: number) => {
      await tracer.setCamera({ ...camera, transform: at(0.3 * time, 0, 3) } as Camera);
      await tracer.setInstanceTransform(1, at(0, 0.4 * time, 0));
      await tracer.setLight('key', { intensity: 3 - 2 * time });
      const positions = flat.positions.map((value, i) => (i % 3 === 2 ? 0.2 * time : value));
      await tracer.replaceMesh(0, { ...flat, positions });
    };
    const tracer = await PathTracer.create(device, scene, options);
    const settings = { samples: 20, times: 5, seed: 3 };
    const blurred = await exposed(tracer, { ...settings, pose: (time) => pose(tracer, time) });
    const mean = new Float64Array(blurred.length);
    let from = 0;
    for (const { time, until } of shutterTimes(settings)) {
      const one = await PathTracer.create(device, scene, options);
      await pose(one, time);
      one.reset({ firstSample: from });
      for await (const _ of one.render({ samples: until - from }));
      const film = await one.read('beauty');
      for (let i = 0; i < film.length; i++) mean[i]! += (film[i]! * (until - from)) / settings.samples;
      one.destroy();
      from = until;
    }
    // Sums of 20 samples in single precision, and means of their parts.
    const rounding = 24 * 2 ** -23;
    for (let i = 0; i < mean.length; i++)
      expect(Math.abs(blurred[i]! - mean[i]!)).toBeLessThanOrEqual(rounding * mean[i]!);
    await pose(tracer, 0);
    tracer.reset();
    for await (const _ of tracer.render({ samples: 20 }));
    const still = await tracer.read('beauty');
    expect(still.filter((value, i) => Math.abs(value - blurred[i]!) > 0.01).length).toBeGreaterThan(100);
    tracer.destroy();
  });

  it('has a linear ramp where an edge moves at a constant speed', async () => {
    const [width, height] = [48, 16];
    const scene = createScene();
    addQuad(scene, 10, 0, emitter, { transform: at(-10) });
    // One metre is 16 pixels: the edge moves from column 16 to column 36.
    const view: Camera = { type: 'orthographic', name: 'front', transform: at(1.5, 0, 5), xmag: 1.5, ymag: 0.5 };
    const tracer = await PathTracer.create(device, scene, { width, height, camera: view, ...dark });
    const [from, to] = [1, 2.25];
    const pose = (time: number) => tracer.setInstanceTransform(0, at(-10 + from + (to - from) * time));
    const samples = 64;
    const film = await exposed(tracer, { samples, pose });
    let ramp = 0;
    for (let x = 0; x < width; x++) {
      let mean = 0;
      for (let y = 0; y < height; y++) mean += film[4 * (y * width + x)]! / height;
      // A box filter takes the mean over the pixel: that of the ramp at its centre, but for its two ends.
      if (Math.abs(x + 0.5 - 16) < 1 || Math.abs(x + 0.5 - 36) < 1) continue;
      const expected = Math.min(1, Math.max(0, (36 - x - 0.5) / 20));
      if (expected > 0 && expected < 1) ramp++;
      // Of the strata of time, those in which the edge crosses the pixel, 64 / 20 and two that it shares, give 0 or 1 at
      // random, with a variance of at most 1/4; rows are independent. Five standard deviations.
      const sigma = Math.sqrt((samples / 20 + 2) / 4) / samples / Math.sqrt(height);
      expect(Math.abs(mean - expected), `column ${x}`).toBeLessThan(expected % 1 === 0 ? 1e-6 : 5 * sigma);
    }
    expect(ramp).toBe(18);
    tracer.destroy();
  });

  it('is as wide as the image of the angle that the camera turns by', async () => {
    const [width, height] = [64, 4];
    const scene = createScene();
    // A bar straight ahead at a distance of 4, a pixel wide.
    addQuad(scene, 1, 0, emitter, { transform: [0.05, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -4, 1] });
    const half = Math.tan(0.05);
    const angles = [-0.4, 0.3] as const;
    const tracer = await PathTracer.create(device, scene, {
      width,
      height,
      ...dark,
      camera: { type: 'perspective', name: 'turning', transform: at(0), yfov: 2 * Math.atan(half) },
    });
    const pose = (time: number) => {
      const angle = angles[0] + (angles[1] - angles[0]) * time;
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      const transform = [c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0, 0, 0, 1];
      return tracer.setCamera({ type: 'perspective', name: 'turning', transform, yfov: 2 * Math.atan(half) });
    };
    const film = await exposed(tracer, { samples: 160, pose });
    const lit = Array.from({ length: width }, (_, x) => x).filter((x) =>
      [0, 1, 2, 3].some((y) => film[4 * (y * width + x)]! > 0),
    );
    // Turned by a to the left, the camera sees what lies ahead at tan(a) to the right, in units of half the image's height.
    const column = (angle: number) => width / 2 + ((height / 2) * Math.tan(angle)) / half;
    // Half of the bar lies beyond; between two times it moves by less than a quarter of a pixel.
    expect(Math.abs(lit[0]! + 0.5 - (column(angles[0]) - 0.5))).toBeLessThanOrEqual(1);
    expect(Math.abs(lit.at(-1)! + 0.5 - (column(angles[1]) + 0.5))).toBeLessThanOrEqual(1);
    expect(lit.length).toBe(lit.at(-1)! - lit[0]! + 1);
    expect(lit.length).toBeLessThan(width - 16);
    tracer.destroy();
  });

  it('begins again where a pose needs other kernels, and ends an abort with what it has', async () => {
    const scene = createScene();
    addQuad(scene, 0.8, 0, lambert(0.5));
    scene.environment = { type: 'constant', radiance: [1, 0.9, 0.8] };
    const options: PathTracerOptions = { width: 16, height: 16, camera, maxDepth: 3 };
    const set = async (tracer: PathTracer, coat: number) => {
      await tracer.setMaterial(0, { coat_weight: coat });
    };
    const tracer = await PathTracer.create(device, scene, options);
    const times: number[] = [];
    const settings = { samples: 8, times: 2 };
    const pose = (time: number) => {
      times.push(time);
      return set(tracer, time < 0.5 ? 0 : 1);
    };
    const film = await exposed(tracer, { ...settings, pose });
    const [first, second] = shutterTimes(settings).map(({ time }) => time);
    expect(times).toEqual([first, second, first, second]);
    const mean = new Float64Array(film.length);
    for (const [index, coat] of [0, 1].entries()) {
      const one = await PathTracer.create(device, scene, options);
      await set(one, coat);
      one.reset({ firstSample: 4 * index });
      for await (const _ of one.render({ samples: 4 }));
      (await one.read('beauty')).forEach((value, i) => (mean[i]! += value / 2));
      one.destroy();
    }
    for (let i = 0; i < mean.length; i++) expect(Math.abs(film[i]! - mean[i]!)).toBeLessThanOrEqual(1e-5 * mean[i]!);

    const abort = new AbortController();
    const stopping = (time: number) => void (time > 0.5 && abort.abort());
    for await (const _ of renderShutter(tracer, { ...settings, signal: abort.signal, pose: stopping }));
    expect([tracer.samples, tracer.accumulates]).toEqual([4, false]);
    tracer.destroy();
  });
});

import { RealtimeIntegrator, TEMPORAL_AOVS, type FrameIntegrator } from '@glanz/denoise/temporal';
import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { createCornellBox } from '@glanz/models';
import { PathTracer, type RenderOptions, type RenderProgress } from '@glanz/renderer';
import { afterEach, beforeAll, expect, it } from 'vitest';
import { orbited } from '../../src/motion/orbit';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});
afterEach(() => expectNoGpuErrors());

const [WIDTH, HEIGHT] = [48, 36];
const scene = createCornellBox();
const camera = scene.cameras[0]!;

const tracerOf = (maxDepth = 3) =>
  PathTracer.create(device, scene, { width: WIDTH, height: HEIGHT, camera, maxDepth, aovs: TEMPORAL_AOVS });

/** A frame of either integrator. */
async function frame(integrator: FrameIntegrator<RenderOptions, RenderProgress>, samples = 1): Promise<Float32Array> {
  for await (const progress of integrator.render({ samples })) void progress;
  return integrator.read('beauty');
}

function error(image: Float32Array, reference: Float32Array): number {
  let sum = 0;
  image.forEach((value, i) => (sum += (Math.min(value, 2) - Math.min(reference[i]!, 2)) ** 2));
  return Math.sqrt(sum / image.length);
}

it('has less noise in motion than the progressive one, and leaves the film as if nothing had moved', async () => {
  const moving = await tracerOf();
  const realtime = await RealtimeIntegrator.create(device, moving);
  expect(realtime.filtered).toBe(false);
  let image = await frame(realtime);
  for (let i = 1; i <= 8; i++) {
    await moving.setCamera(orbited(camera, 0.002 * i));
    image = await frame(realtime);
    expect([realtime.filtered, realtime.samples]).toEqual([true, 1]);
  }
  const raw = await moving.read('beauty');

  const still = await tracerOf();
  await still.setCamera(orbited(camera, 0.016));
  const reference = await frame(still, 128);
  expect(error(image, reference)).toBeLessThan(0.5 * error(raw, reference));

  expect(realtime.shifted).toBe(true);
  realtime.rest();
  expect([realtime.shifted, realtime.filtered, realtime.beautyBuffer]).toEqual([false, false, moving.beautyBuffer]);
  still.reset();
  expect(await frame(moving, 6)).toEqual(await frame(still, 6));
  realtime.destroy();
  moving.destroy();
  still.destroy();
});

it('renders each film with other random numbers, also where a frame was broken off', async () => {
  const tracer = await tracerOf();
  const realtime = await RealtimeIntegrator.create(device, tracer);
  const films: string[] = [];
  for (let i = 0; i < 4; i++) {
    tracer.reset();
    for await (const progress of realtime.render({ samples: 2, maxSubmitMs: 0.1 })) {
      void progress;
      if (i === 1) break;
    }
    films.push((await tracer.read('beauty')).join());
  }
  expect(new Set(films).size).toBe(4);
  realtime.destroy();
  tracer.destroy();
});

it('follows edits of a view that does not move, and continues a film that has not changed', async () => {
  const tracer = await tracerOf();
  const realtime = await RealtimeIntegrator.create(device, tracer);
  let image = await frame(realtime);
  for (let i = 0; i < 6; i++) {
    tracer.reset();
    image = await frame(realtime);
  }
  const still = await tracerOf();
  const reference = await frame(still, 128);
  const settled = error(image, reference);
  // Two more samples of the same film.
  expect(error(await frame(realtime, 3), reference)).toBeLessThan(1.1 * settled);
  expect(realtime.samples).toBe(3);
  // The history is that of another light: without it the frame would be as noisy as its sample.
  const index = scene.materials.findIndex(({ parameters }) => (parameters.emission_luminance ?? 0) > 0);
  await tracer.setMaterial(index, { emission_luminance: 0.9 * scene.materials[index]!.parameters.emission_luminance! });
  image = await frame(realtime);
  const darker = await tracerOf();
  await darker.setMaterial(index, { emission_luminance: 0.9 * scene.materials[index]!.parameters.emission_luminance! });
  const expected = await frame(darker, 128);
  expect(error(image, expected)).toBeLessThan(0.5 * error(await tracer.read('beauty'), expected));
  for (const one of [realtime, tracer, still, darker]) one.destroy();
});

it('reuses light samples where that is asked for, and leaves the film as it is', async () => {
  const tracer = await tracerOf();
  const realtime = await RealtimeIntegrator.create(device, tracer, { lightReuse: true });
  const images: { first: Float32Array; last?: Float32Array } = { first: await frame(realtime) };
  for (let i = 1; i <= 4; i++) {
    await tracer.setCamera(orbited(camera, 0.002 * i));
    images.last = await frame(realtime);
  }
  const still = await tracerOf();
  await still.setCamera(orbited(camera, 0.008));
  const reference = await frame(still, 128);
  expect(error(images.last!, reference)).toBeLessThan(error(images.first, reference));
  // Samples of the same numbers without reuse are others.
  const raw = await tracer.read('beauty');
  still.reset({ firstSample: 5 });
  expect(await frame(still, 1)).not.toEqual(raw);
  realtime.rest();
  still.reset({ firstSample: 0 });
  expect(await frame(tracer, 4)).toEqual(await frame(still, 4));
  for (const one of [realtime, tracer, still]) one.destroy();
});

it('shows the film itself where it is destroyed', async () => {
  const tracer = await tracerOf();
  const realtime = await RealtimeIntegrator.create(device, tracer);
  await frame(realtime);
  realtime.destroy();
  expect(realtime.beautyBuffer).toBe(tracer.beautyBuffer);
  tracer.reset();
  expect(await frame(realtime)).toEqual(await tracer.read('beauty'));
  tracer.destroy();
});

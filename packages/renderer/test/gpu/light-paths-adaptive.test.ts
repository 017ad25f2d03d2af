import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Mesh, PerspectiveCamera, Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions, type RenderOptions, type RenderProgress } from '../../src/index';
import { addQuad, addSphere, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

/** Four tiles of 8 × 8 pixels, two of them with the caustic. */
const SIZE = 16;
const NOISE = 0.1;

/** Looks down on the floor: the ball's shadow with the caustic in the middle, lit floor around it. */
const camera: PerspectiveCamera = {
  type: 'perspective',
  name: 'camera',
  transform: [1, 0, 0, 0, 0, 0.6, -0.8, 0, 0, 0.8, 0.6, 0, 0, 2, 1.5, 1],
  yfov: 0.6,
};

/** A glass ball over a matt floor, below a small light. */
function caustic(): Scene {
  const scene = createScene();
  addQuad(scene, 2, 0, lambert(0.7));
  const parameters = { base_weight: 0, transmission_weight: 1, specular_roughness: 0 };
  addSphere(scene, 0.3, [0, 0, 0.5], { name: 'glass', parameters });
  const glow = { base_weight: 0, specular_weight: 0, emission_luminance: 15 };
  addQuad(
    scene,
    0.3,
    0,
    { name: 'light', parameters: glow },
    { transform: [1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0.2, 0.1, 2.2, 1] },
  );
  return scene;
}

const start = (options: Partial<PathTracerOptions> = {}) =>
  PathTracer.create(device, caustic(), { width: SIZE, height: SIZE, camera, maxDepth: 4, lightPaths: 0.5, ...options });

async function run(tracer: PathTracer, options: RenderOptions): Promise<RenderProgress[]> {
  const seen: RenderProgress[] = [];
  for await (const progress of tracer.render({ maxSubmitMs: 1000, ...options })) seen.push(progress);
  return seen;
}

const mean = (values: readonly number[]) => values.reduce((a, b) => a + b, 0) / values.length;

/** The mean of the image over films of several seeds, with its standard error. */
async function measure(options: Partial<PathTracerOptions>, until: RenderOptions) {
  const totals: number[] = [];
  const active: number[] = [];
  for (let seed = 1; seed <= 8; seed++) {
    const tracer = await start({ ...options, seed });
    active.push(...(await run(tracer, until)).map((progress) => progress.active));
    totals.push(mean([...(await tracer.read('beauty'))].filter((_, i) => i % 4 < 3)));
    expect(tracer.statistics.badSamples).toBe(0);
    tracer.destroy();
  }
  const whole = mean(totals);
  const variance = totals.reduce((sum, total) => sum + (total - whole) ** 2, 0) / (totals.length - 1);
  return { mean: whole, error: Math.sqrt(variance / totals.length), active };
}

describe('adaptive sampling with light paths', () => {
  it('has the mean of images without either', async () => {
    const adaptive = await measure({}, { noise: NOISE, samples: 256 });
    const even = await measure({}, { samples: 64 });
    const plain = await measure({ lightPaths: 0 }, { samples: 64 });
    // Light paths fall on some tiles that are still rendered, and on others that are done.
    expect(adaptive.active.some((active) => active > 0 && active < 0.8)).toBe(true);
    // The means of 8 films have standard errors of 0.07 and 0.08 %: 0.5 % is beyond four of both together. Without the
    // light paths of the samples after the first 64 the mean is 2.3 % less.
    expect(Math.abs(adaptive.mean / even.mean - 1)).toBeLessThan(0.005);
    // Six standard errors, each estimated from 8 films: by chance once in 30,000.
    expect(Math.abs(adaptive.mean - plain.mean)).toBeLessThan(6 * Math.hypot(adaptive.error, plain.error));
  });

  it('gives the same image, bit for bit, whatever the batches and interruptions', async () => {
    const one = await start();
    await run(one, { noise: NOISE });
    // Parts of the image, each of which traces all light paths of its samples.
    const two = await start({ pathsInFlight: 100 });
    const control = new AbortController();
    for await (const { samples } of two.render({ noise: NOISE, signal: control.signal, maxSubmitMs: 5 }))
      if (samples > 70) control.abort();
    await run(two, { noise: NOISE, maxSubmitMs: 20 });
    expect(two.samples).toBe(one.samples);
    expect(one.samples).toBeGreaterThan(64);
    expect(await two.read('beauty')).toEqual(await one.read('beauty'));
    expect(await two.read('variance')).toEqual(await one.read('variance'));
    one.destroy();
    two.destroy();
  });

  it('evens out to the image that all samples make', async () => {
    const tracer = await start();
    await run(tracer, { noise: NOISE });
    const samples = tracer.samples + 3;
    await run(tracer, { samples });
    const plain = await start();
    await run(plain, { samples });
    expect(await tracer.read('beauty')).toEqual(await plain.read('beauty'));
    tracer.destroy();
    plain.destroy();
  });
});

it('looks at the instances for light paths after edits of them alone, not for each move of the camera', async () => {
  const scene = caustic();
  let looks = 0;
  scene.meshes = scene.meshes.map((mesh): Mesh => {
    const { positions } = mesh;
    return Object.defineProperty({ ...mesh }, 'positions', { get: () => (looks++, positions), enumerable: true });
  });
  scene.environment = { type: 'latlong', width: 1, height: 1, data: Float32Array.of(0.1, 0.1, 0.1) };
  const tracer = await PathTracer.create(device, scene, {
    width: SIZE,
    height: SIZE,
    camera,
    maxDepth: 4,
    lightPaths: 0.5,
  });
  const looksOf = async (edit: () => Promise<void> | void) => {
    await edit();
    looks = 0;
    await run(tracer, { samples: tracer.samples + 1 });
    return looks;
  };
  const later = { ...camera, yfov: 0.5 };
  expect(await looksOf(() => {})).toBeGreaterThan(0);
  expect(await looksOf(() => tracer.setCamera(later))).toBe(0);
  expect(await looksOf(() => tracer.adjustEnvironment({ intensity: 2 }))).toBe(0);
  expect(await looksOf(() => tracer.setInstanceTransform(1, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0.1, 1]))).toBe(
    scene.instances.length,
  );
  expect(await looksOf(() => tracer.setCamera(camera))).toBe(0);
  expect(await looksOf(() => tracer.setMaterial('glass', { specular_ior: 1.3 }))).toBe(scene.instances.length);
  expect(await looksOf(() => tracer.setVisibility(1, false))).toBe(scene.instances.length - 1);
  tracer.destroy();
});

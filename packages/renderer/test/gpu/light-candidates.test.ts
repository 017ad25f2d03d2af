import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Light, Scene } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { addQuad, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

const SIZE = 16;

/** A glossy floor below ten lights of different intensities. `hidden`: the brightest is covered, and the sky has a bright half. */
function litFloor(hidden = false): Scene {
  const scene = createScene();
  addQuad(scene, 1, 0, { ...lambert(0.8), parameters: { ...lambert(0.8).parameters, specular_weight: 1 } });
  const points = Array.from({ length: 9 }, (_, i): Light => {
    const [x, y] = [Math.sin(2.4 * i), Math.cos(2.4 * i)];
    return { type: 'point', name: `light ${i}`, color: [1, 0.9, 0.8], intensity: 1.5 ** i / 10, position: [x, y, 1] };
  });
  scene.lights.push(...points, {
    type: 'sphere',
    name: 'ball',
    color: [1, 0.8, 0.6],
    intensity: 10,
    position: [0, 0, 2],
    radius: 0.3,
    visible: false,
  });
  if (hidden) {
    const data = new Float32Array(8 * 4 * 3).map((_, i) => (i % 24 < 12 ? 2 : 0.1));
    scene.environment = { type: 'latlong', width: 8, height: 4, data };
    const { position } = points[8] as Extract<Light, { type: 'point' }>;
    const [x, y] = position!;
    addQuad(scene, 0.1, 0.9, lambert(0.5), { transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x!, y!, 0, 1] });
  }
  return scene;
}

async function film(scene: Scene, samples: number, options: Partial<PathTracerOptions>): Promise<Float32Array> {
  const tracer = await PathTracer.create(device, scene, { width: SIZE, height: SIZE, camera, maxDepth: 3, ...options });
  for await (const _ of tracer.render({ samples }));
  const image = await tracer.read('beauty');
  tracer.destroy();
  return image;
}

/** Mean of the image, its standard error, and the mean variance of pixels, over seeds. */
async function measure(scene: Scene, options: Partial<PathTracerOptions>) {
  const images: Float32Array[] = [];
  for (let seed = 1; seed <= 6; seed++)
    images.push(await film(scene, 16, { sampler: 'independent', ...options, seed }));
  const mean = (values: readonly number[]) => values.reduce((a, b) => a + b) / values.length;
  const pixels = Array.from({ length: SIZE * SIZE }, (_, i) => images.map((image) => image[4 * i]!));
  const variances = pixels.map((values) => {
    const middle = mean(values);
    return values.reduce((sum, value) => sum + (value - middle) ** 2, 0) / (values.length - 1);
  });
  const variance = mean(variances);
  return { mean: mean(pixels.map(mean)), variance, error: Math.sqrt(variance / (images.length * pixels.length)) };
}

describe('PathTracer with several candidates for light samples', () => {
  it.each([
    ['all lights visible', litFloor()],
    ['the brightest light hidden, below a sky', litFloor(true)],
  ])('leaves the mean as it is, and takes most of the noise: %s', async (_, scene) => {
    for (const lightSampling of ['tree', 'power'] as const) {
      const plain = await measure(scene, { lightSampling });
      const several = await measure(scene, { lightSampling, lightCandidates: 5 });
      // Five standard errors: by chance once in 1.7 million.
      expect(Math.abs(several.mean - plain.mean)).toBeLessThan(5 * Math.hypot(plain.error, several.error));
      // 1,280 degrees of freedom each: a ratio of variances is known within 20 %; those of these scenes are 0.13 to 0.23.
      expect(several.variance).toBeLessThan(0.4 * plain.variance);
    }
  });

  it('is as without the option where there is one candidate', async () => {
    expect(await film(litFloor(), 2, { lightCandidates: 1 })).toEqual(await film(litFloor(), 2, {}));
  });

  it('gives the same film, bit for bit, however it is cut into batches', async () => {
    const whole = await film(litFloor(), 2, { lightCandidates: 3 });
    expect(await film(litFloor(), 2, { lightCandidates: 3, pathsInFlight: 128 })).toEqual(whole);
  });
});

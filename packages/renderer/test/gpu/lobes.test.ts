// Haze and retroreflection in the kernels: what one surface sends to the camera, in environments that are known.
import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Material } from '@glanz/scene';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { PathTracer } from '../../src/index';
import { addQuad, camera, createScene } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});
afterAll(() => expectNoGpuErrors());

const SIZE = 8;
const SAMPLES = 64;

/** Mean of the image of a large surface, seen from above it and a little from the side. */
async function mean(parameters: Material['parameters'], pointLight = false): Promise<number> {
  const scene = createScene();
  addQuad(scene, 50, 0, { name: 'subject', parameters });
  const [s, c] = [Math.sin(0.6), Math.cos(0.6)];
  if (pointLight) {
    // Behind the camera alone, where its rays come from: nothing that is mirrored forward meets it.
    const emitter = { base_weight: 0, specular_weight: 0, emission_luminance: 1 };
    const transform = [c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 30 * s, 0, 30 * c, 1];
    addQuad(scene, 5, 0, { name: 'emitter', parameters: emitter }, { flip: true, transform });
  } else scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  const view = { ...camera, transform: [c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 20 * s, 0, 20 * c, 1], yfov: 0.05 };
  const tracer = await PathTracer.create(device, scene, { width: SIZE, height: SIZE, camera: view });
  try {
    for await (const progress of tracer.render({ samples: SAMPLES })) void progress;
    const pixels = await tracer.read('beauty');
    let sum = 0;
    for (let i = 0; i < SIZE * SIZE; i++) sum += pixels[4 * i + 1]!;
    return sum / SIZE / SIZE;
  } finally {
    tracer.destroy();
  }
}

const white = { base_color: [1, 1, 1], base_metalness: 1 } as const;
const both = { specular_haze: 0.5, specular_haze_spread: 0.5, specular_retroreflectivity: 0.5 } as const;

it.each([
  ['metal', { ...white, ...both, specular_roughness: 0.2 }],
  ['a mirror', { ...white, ...both, specular_roughness: 0 }],
  ['a smooth pane', { ...both, specular_roughness: 0, transmission_weight: 1, geometry_thin_walled: true }],
] as const)('%s with both is as bright as what surrounds it', async (_, parameters) => {
  // The mean of 4096 samples of white surfaces, which keep 0.997 to 1.003 of the light.
  expect(Math.abs((await mean(parameters)) - 1)).toBeLessThan(0.01);
});

it('a mirror sends the share of retroreflection back to the light beside the camera, and plain ones nothing', async () => {
  const mirror = { ...white, specular_roughness: 0 };
  expect(await mean(mirror, true)).toBe(0);
  expect(await mean({ ...mirror, specular_retroreflectivity: 1 }, true)).toBeCloseTo(1, 3);
  // The direction is one or the other: 4096 samples of a coin.
  expect(Math.abs((await mean({ ...mirror, specular_retroreflectivity: 0.25 }, true)) - 0.25)).toBeLessThan(0.03);
});

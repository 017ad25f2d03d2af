import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { PathTracer, type FirstLight } from '../../src/index';
import { readBuffer } from '../../src/storage/read-buffer';
import { addQuad, addSphere, camera, createScene, lambert, meanOf } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

it('shows base colours and the background while the kernels compile, and is gone with them', async () => {
  const scene = createScene();
  addQuad(scene, 0.6, 0, {
    ...lambert(0.5, 0.25, 0.125),
    parameters: {
      base_color: [0.5, 0.25, 0.125],
      specular_weight: 0.7,
      coat_weight: 0.4,
      transmission_weight: 0.01,
      geometry_opacity: 0.9,
    },
  });
  addSphere(scene, 0.1, [0, 0, -5], lambert(1), 8);
  scene.environment = { type: 'constant', radiance: [2, 2, 2] };
  const shown: Promise<Float32Array>[] = [];
  let kept: FirstLight | undefined;
  let compiled = 0;
  const tracer = await PathTracer.create(device, scene, {
    width: 17,
    height: 17,
    camera,
    seed: 77,
    onProgress: ({ stage, done }) => (compiled = stage === 'compile' ? done : compiled),
    onFirstLight(image) {
      kept = image;
      expect(compiled).toBeLessThan(1);
      shown.push(readBuffer(device, image.buffer, 16 * 17 * 17).then((bytes) => new Float32Array(bytes)));
    },
  });
  expect(shown).toHaveLength(1);
  expect([kept!.width, kept!.height]).toEqual([17, 17]);
  const pixels = await shown[0]!;
  // Facing the light, a facet is as bright as in a constant environment; the background is that of the environment.
  meanOf(pixels, 17, 8, 8, 9, 9).forEach((value, k) => expect(value).toBeCloseTo(2 * [0.5, 0.25, 0.125][k]!, 3));
  meanOf(pixels, 17, 0, 0, 1, 1).forEach((value) => expect(value).toBeCloseTo(2, 5));
  for (let i = 3; i < pixels.length; i += 4) expect(pixels[i]).toBe(1);
  tracer.destroy();
});

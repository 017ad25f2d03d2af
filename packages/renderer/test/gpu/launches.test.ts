import { testDevice } from '@glanz/gpu';
import { afterAll, beforeAll, expect, it, vi } from 'vitest';
import { PathTracer } from '../../src/index';
import { addQuad, addSphere, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => device.destroy());

// Test machines have no GPU, so that one of the two ways is never gone by itself.
it('the image is the same bit for bit whether the GPU counts the paths that are left or threads without one end', async () => {
  const scene = createScene();
  addQuad(scene, 5, -1, lambert(0.7));
  addQuad(scene, 1, 3, { name: 'lamp', parameters: { emission_luminance: 5 } }, { flip: true });
  addSphere(
    scene,
    0.5,
    [0, 0, 0],
    {
      name: 'milk',
      parameters: {
        transmission_weight: 1,
        specular_roughness: 0.2,
        transmission_depth: 0.3,
        transmission_scatter: [0.8, 0.7, 0.6],
      },
    },
    16,
  );
  scene.environment = { type: 'constant', radiance: [0.2, 0.3, 0.4] };
  const pass = device.createCommandEncoder().beginComputePass();
  const indirect = vi.spyOn(Object.getPrototypeOf(pass) as GPUComputePassEncoder, 'dispatchWorkgroupsIndirect');
  const image = async () => {
    const tracer = await PathTracer.create(device, scene, {
      width: 16,
      height: 12,
      camera,
      maxDepth: 6,
      maxVolumeDepth: 48,
      pathsInFlight: 400,
    });
    for await (const _ of tracer.render({ samples: 4 }));
    const pixels = await tracer.read('beauty');
    const rays = await tracer.readRayCount();
    expect(tracer.statistics.badSamples).toBe(0);
    tracer.destroy();
    return { pixels, rays };
  };
  const counted = await image();
  expect(indirect).toHaveBeenCalled();
  indirect.mockClear();
  Object.defineProperty(device, 'adapterInfo', {
    value: { vendor: 'a', architecture: 'real', device: 'one', description: '' },
  });
  const launched = await image();
  expect(indirect).not.toHaveBeenCalled();
  expect(launched.rays).toBe(counted.rays);
  expect(launched.pixels.every((value, i) => Object.is(value, counted.pixels[i]))).toBe(true);
  // And it is an image.
  expect(new Set(counted.pixels).size).toBeGreaterThan(300);
});

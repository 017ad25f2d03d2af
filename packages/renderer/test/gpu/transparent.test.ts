import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Environment, Material, Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { addQuad, addSphere, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

const SIZE = 12;

async function image(
  scene: Scene,
  background: NonNullable<PathTracerOptions['background']>,
  samples = 32,
): Promise<Float32Array> {
  const tracer = await PathTracer.create(device, scene, {
    width: SIZE,
    height: SIZE,
    camera,
    background,
    maxDepth: 10,
    pathsInFlight: 1 << 13,
  });
  for await (const _ of tracer.render({ samples, maxSubmitMs: 2000 }));
  const pixels = await tracer.read('beauty');
  tracer.destroy();
  return pixels;
}

const glass = (roughness: number, thin = false, color: readonly [number, number, number] = [1, 1, 1]): Material => ({
  name: 'glass',
  parameters: {
    transmission_weight: 1,
    transmission_color: color,
    specular_ior: 1.5,
    specular_roughness: roughness,
    geometry_thin_walled: thin,
  },
});
const SKY = [0.3, 0.6, 0.9] as const;

describe('a transparent background', () => {
  it.each([
    ['smooth glass', glass(0)],
    ['rough glass', glass(0.4)],
    ['a thin wall', glass(0.2, true)],
  ])('seen through %s: composited over the environment it is the image with it', async (_, material) => {
    const scene = createScene();
    addSphere(scene, 0.6, [0, 0, 0], material, 24);
    addQuad(scene, 0.3, -0.8, lambert(0.7, 0.2, 0.1), {
      transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5, 0.4, 0, 1],
    });
    scene.environment = { type: 'constant', radiance: SKY };
    const opaque = await image(scene, 'environment');
    const clear = await image(scene, 'transparent');
    let partial = 0;
    for (let i = 0; i < SIZE * SIZE; i++) {
      const alpha = clear[4 * i + 3] as number;
      if (alpha > 0.05 && alpha < 0.95) partial++;
      // Colourless glass and a constant environment: path for path the same light, so only rounding differs.
      for (let c = 0; c < 3; c++)
        expect(
          Math.abs((clear[4 * i + c] as number) + (1 - alpha) * (SKY[c] as number) - (opaque[4 * i + c] as number)),
        ).toBeLessThan(1e-4);
    }
    // The middle of the ball, not its silhouette alone.
    expect(partial).toBeGreaterThan(20);
    expect([...clear.subarray(0, 4)]).toEqual([0, 0, 0, 0]);
  });

  it('is not lit from behind through glass, however it is sampled', async () => {
    const scene = createScene();
    addQuad(scene, 5, 0, glass(0.5, true));
    // Bright behind the wall (−z), black before it: u = atan2(z, x)/2π + ½ is below ½ for z < 0.
    const data = Float32Array.from({ length: 32 * 16 * 3 }, (_, i) =>
      Math.floor(i / 3) % 32 < 15 && Math.floor(i / 3) % 32 > 0 ? 2 : 0,
    );
    scene.environment = { type: 'latlong', width: 32, height: 16, data } satisfies Environment;
    const opaque = await image(scene, 'environment', 64);
    const clear = await image(scene, 'transparent', 64);
    for (let i = 0; i < SIZE * SIZE; i++) {
      expect(opaque[4 * i]).toBeGreaterThan(0.5);
      expect(clear[4 * i] as number).toBeLessThan(1e-6);
      expect(clear[4 * i + 3]).toBeLessThan(0.4);
    }
  });

  it('coloured glass covers as much as it takes, and what is behind glass covers all', async () => {
    const color = [0.9, 0.5, 0.2] as const;
    const scene = createScene();
    addQuad(scene, 5, 0, glass(0, true, color));
    scene.environment = { type: 'constant', radiance: [1, 1, 1] };
    const white = createScene();
    addQuad(white, 5, 0, glass(0, true));
    white.environment = scene.environment;
    // Through a clear wall passes 1 − α; through a coloured one that, times about its colour's luminance.
    const clear = await image(white, 'transparent', 256);
    const tinted = await image(scene, 'transparent', 256);
    const mean = (pixels: Float32Array) =>
      pixels.reduce((sum, value, i) => (i % 4 === 3 ? sum + value : sum), 0) / (SIZE * SIZE);
    const luminance = 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
    expect((1 - mean(tinted)) / (1 - mean(clear)) / luminance).toBeGreaterThan(0.9);
    expect((1 - mean(tinted)) / (1 - mean(clear)) / luminance).toBeLessThan(1.1);
    addQuad(scene, 5, -1, lambert(0.5));
    expect(mean(await image(scene, 'transparent'))).toBeCloseTo(1, 5);
  });
});

import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Light, Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { allLights } from '../light-scene';
import { addQuad, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

const SIZE = 24;

const at = (x: number, y: number, z = 0) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1];

/** A floor below forty small lights, and a card that hides some of them from parts of it. */
function litFloor(): Scene {
  const scene = createScene();
  addQuad(scene, 1, 0, lambert(0.8));
  addQuad(scene, 0.3, 0.5, lambert(0.5), { transform: at(0.4, 0.2) });
  scene.lights.push(
    ...Array.from({ length: 40 }, (_, i): Light => {
      const position = [Math.sin(2.4 * i), Math.cos(2.4 * i), 0.9] as const;
      return {
        type: 'point',
        name: `light ${i}`,
        color: [1, 0.9, 0.8],
        intensity: 1.2 ** (i % 20) / 40,
        position,
      };
    }),
  );
  return scene;
}

const tracerOf = (scene: Scene, options: Partial<PathTracerOptions> = {}) =>
  PathTracer.create(device, scene, {
    width: SIZE,
    height: SIZE,
    camera,
    maxDepth: 2,
    lightSampling: 'power',
    ...options,
  });

async function film(tracer: PathTracer, samples: number): Promise<Float32Array> {
  for await (const _ of tracer.render({ samples }));
  return tracer.read('beauty');
}

/** Frames of one sample each. */
async function frames(
  tracer: PathTracer,
  count: number,
  { lightReuse = true, before = (_: number): Promise<void> | void => {} } = {},
): Promise<Float32Array[]> {
  const images: Float32Array[] = [];
  for (let i = 0; i < count; i++) {
    await before(i);
    tracer.reset({ firstSample: 1 + i, lightReuse });
    images.push(await film(tracer, 1));
  }
  return images;
}

async function reference(scene: Scene, samples: number, options?: Partial<PathTracerOptions>): Promise<Float32Array> {
  const tracer = await tracerOf(scene, options);
  const image = await film(tracer, samples);
  tracer.destroy();
  return image;
}

const sum = (values: readonly number[]) => values.reduce((a, b) => a + b, 0);
const colors = (image: Float32Array) => Array.from(image).filter((_, i) => i % 4 < 3);
const brightness = (images: readonly Float32Array[]) =>
  sum(images.map((image) => sum(colors(image)) / (0.75 * image.length))) / images.length;
const averageOf = (images: readonly Float32Array[]) =>
  images[0]!.map((_, i) => sum(images.map((image) => image[i]!)) / images.length);

/** Mean relative squared error. */
function error(image: Float32Array, truth: Float32Array): number {
  const expected = colors(truth);
  return sum(colors(image).map((value, i) => ((value - expected[i]!) / (expected[i]! + 0.05)) ** 2)) / expected.length;
}

describe('light reuse', () => {
  it('takes noise from frames and from their average, and keeps the brightness', async () => {
    const truth = await reference(litFloor(), 1024);
    const tracer = await tracerOf(litFloor());
    const raw = await frames(tracer, 8, { lightReuse: false });
    await tracer.setLightReuse(true);
    const reused = (await frames(tracer, 16)).slice(8);
    tracer.destroy();
    const one = (images: readonly Float32Array[]) => sum(images.map((image) => error(image, truth))) / images.length;
    expect(one(reused)).toBeLessThan(one(raw) / 8);
    expect(error(averageOf(reused), truth)).toBeLessThan(error(averageOf(raw), truth) / 3);
    expect(Math.abs(brightness(reused) / brightness([truth]) - 1)).toBeLessThan(0.02);
  });

  it('finds surfaces where they were, when the camera and when they move', async () => {
    const aside = (i: number) => ({
      ...camera,
      transform: Array.from(camera.transform, (x, k) => (k === 12 ? x + 0.03 * i : x)),
    });
    const turned = (i: number) => at(0.4 - 0.06 * i, 0.2);
    const tracer = await tracerOf(litFloor());
    await tracer.setLightReuse(true);
    const moving = await frames(tracer, 10, {
      before: async (i) => {
        await tracer.setCamera(aside(i));
        if (i > 0) await tracer.setInstanceTransform(1, turned(i));
      },
    });
    // The same frame without those before it.
    await tracer.setVisibility(0, false);
    await tracer.setVisibility(0, true);
    tracer.reset({ firstSample: 10, lightReuse: true });
    const alone = await film(tracer, 1);
    tracer.destroy();
    const scene = litFloor();
    scene.instances[1] = { ...scene.instances[1]!, transform: turned(9) };
    const truth = await reference(scene, 1024, { camera: aside(9) });
    expect(error(moving[9]!, truth)).toBeLessThan(0.7 * error(alone, truth));
  });

  it('gives the light of all kinds of lights', async () => {
    const scene = allLights();
    const options = { width: 16, height: 16, lightSampling: 'tree' } as const;
    const truth = await reference(scene, 512, options);
    const tracer = await tracerOf(scene, options);
    await tracer.setLightReuse(true);
    const images = await frames(tracer, 24);
    // A light that goes is gone with the next frame, and one that moves shines from where it is.
    await tracer.setLight('point', { intensity: 0 });
    await tracer.setInstanceTransform(1, at(-0.2, 0.3, 1.3));
    const later = await frames(tracer, 24);
    tracer.destroy();
    const changed = allLights();
    changed.lights[0] = { ...changed.lights[0]!, intensity: 0 } as Light;
    changed.instances[1] = { ...changed.instances[1]!, transform: at(-0.2, 0.3, 1.3) };
    const expected = await reference(changed, 512, options);
    for (const [list, of] of [
      [images, truth],
      [later, expected],
    ] as const) {
      const each = list.map((image) => brightness([image]));
      const mean = sum(each) / each.length;
      expect(Math.abs(mean / brightness([of]) - 1)).toBeLessThan(0.02);
    }
  });

  it('leaves the film at rest as it is without, and its memory free', async () => {
    const scene = allLights();
    const plain = await tracerOf(scene);
    const expected = await film(plain, 5);
    const tracer = await tracerOf(scene);
    await tracer.setLightReuse(true);
    await frames(tracer, 4);
    const moving = tracer.statistics.gpuBytes;
    tracer.reset({ firstSample: 0 });
    expect(await film(tracer, 5)).toEqual(expected);
    expect(moving - tracer.statistics.gpuBytes).toBeCloseTo(72 * SIZE ** 2, -2);
    await tracer.setLightReuse(false);
    tracer.reset({ lightReuse: true });
    expect(await film(tracer, 5)).toEqual(expected);
    for (const each of [plain, tracer]) each.destroy();
  });

  it('takes other sizes, several samples a frame, and batches of parts of the image', async () => {
    const truth = await reference(litFloor(), 1024);
    const tracer = await tracerOf(litFloor(), { pathsInFlight: 100 });
    await tracer.setLightReuse(true);
    tracer.reset({ firstSample: 1, lightReuse: true });
    await film(tracer, 2);
    await tracer.resize(10, 12);
    tracer.reset({ firstSample: 3, lightReuse: true });
    await film(tracer, 2);
    await tracer.resize(SIZE, SIZE);
    const images: Float32Array[] = [];
    for (let i = 0; i < 6; i++) {
      tracer.reset({ firstSample: 5 + 2 * i, lightReuse: true });
      images.push(await film(tracer, 2));
    }
    tracer.destroy();
    expect(Math.abs(brightness(images) / brightness([truth]) - 1)).toBeLessThan(0.03);
    expect(error(images[5]!, truth)).toBeLessThan(0.8 * error(images[0]!, truth));
  });

  it('has no effect where there are catchers or no lights', async () => {
    const dark = createScene();
    addQuad(dark, 1, 0, lambert(0.5));
    for (const scene of [dark, { ...litFloor(), environment: undefined }] as Scene[]) {
      if (scene !== dark) scene.instances[0] = { ...scene.instances[0]!, catcher: true };
      const plain = await tracerOf(scene);
      const expected = await film(plain, 2);
      const tracer = await tracerOf(scene);
      await tracer.setLightReuse(true);
      tracer.reset({ firstSample: 0, lightReuse: true });
      expect(await film(tracer, 2)).toEqual(expected);
      for (const each of [plain, tracer]) each.destroy();
    }
  });
});

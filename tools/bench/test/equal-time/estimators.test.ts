import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { PathTracerOptions } from '@glanz/renderer';
import { createScene, type PerspectiveCamera, type Scene } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { checkOptions, crossCheck, render, renderReference, type LongRender } from '../../src/equal-time/reference';
import { place, sphere, square, translation } from '../../src/hashes/shapes';

const SIZE = 32;
const SAMPLES = 256;

const camera: PerspectiveCamera = {
  type: 'perspective',
  name: 'camera',
  transform: translation(0.2, 1, 6),
  yfov: 0.6,
};
const options = { width: SIZE, height: SIZE, maxDepth: 6, camera };

/** A glass ball on a matt floor below a light, which it focuses beside itself. */
function caustic(intensity: number): Scene {
  const scene = createScene();
  const glass = { base_weight: 0, transmission_weight: 1, specular_roughness: 0 };
  place(scene, sphere(), { name: 'glass', parameters: glass }, translation(0, 1, 0));
  place(scene, square(), { name: 'floor', parameters: {} }, [4, 0, 0, 0, 0, 0, -4, 0, 0, 4, 0, 0, 0, 0, 0, 1]);
  scene.lights.push({
    type: 'disk',
    name: 'light',
    position: [-1.5, 5, -1.5],
    direction: [0.3, -1, 0.3],
    radius: 1.6,
    color: [1, 1, 1],
    intensity,
  });
  return scene;
}

let device: GPUDevice;
let long: LongRender;
beforeAll(async () => {
  device = await testDevice();
  long = await renderReference(device, caustic(20), options, SAMPLES);
});
afterAll(() => expectNoGpuErrors());

/** How many standard errors the ratio is from 1. */
const errors = ({ ratio, ratio95 }: Pick<LongRender, 'ratio' | 'ratio95'>) => (1.96 * Math.abs(ratio - 1)) / ratio95;

describe('the check of a reference by another estimator', () => {
  it('agrees with it, with a small error', () => {
    expect(long.checkedBy).toMatchObject({ lightPaths: 0.25, lightCandidates: 4 });
    expect(long.ratio95).toBeLessThan(0.05);
    // As in the remarks of a report: by chance once in 370.
    expect(errors(long)).toBeLessThan(3);
    // Beyond three standard errors are 0.7 of 256 blocks where channels err together, and fewer else.
    expect(long.outside).toBeLessThanOrEqual(4);
  });

  const biased: readonly (readonly [string, Scene, Partial<PathTracerOptions>])[] = [
    ['without caustics', caustic(20), { caustics: false }],
    ['with a light that is 10 % too strong', caustic(22), {}],
  ];
  for (const [name, scene, change] of biased)
    it(`finds an image ${name}`, async () => {
      const samples = SAMPLES / 4;
      const check = await render(
        device,
        scene,
        { ...options, ...checkOptions(SIZE, SIZE, samples), seed: 5003, ...change },
        samples,
      );
      expect(errors(crossCheck(check, long.reference))).toBeGreaterThan(3);
    });
});

it('trains the guide of the check by its samples, within limits', () => {
  expect(checkOptions(32, 32, 8).guiding).toBe(0.002);
  expect(checkOptions(512, 512, 64).guiding).toBeCloseTo(1.68, 2);
  expect(checkOptions(1920, 1080, 512).guiding).toBe(16);
});

import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { addQuad, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

const SIZE = 8;

/** Black quads one behind the other in front of a white environment. */
async function veils(
  opacities: readonly number[],
  samples: number,
  options: Partial<PathTracerOptions> = {},
  shift = 0,
  add: (scene: Scene) => void = () => undefined,
) {
  const scene = createScene();
  opacities.forEach((opacity, i) =>
    addQuad(
      scene,
      4,
      -0.5 * i,
      {
        name: `veil ${i}`,
        parameters: { base_color: [0, 0, 0], specular_weight: 0, geometry_opacity: opacity },
      },
      { transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, shift, 0, 0, 1] },
    ),
  );
  add(scene);
  scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  return shown(scene, samples, options);
}

/** Red of all pixels. */
async function shown(scene: Scene, samples: number, options: Partial<PathTracerOptions>) {
  const tracer = await PathTracer.create(device, scene, {
    width: SIZE,
    height: SIZE,
    camera,
    maxDepth: 4,
    pathsInFlight: 1 << 13,
    ...options,
  });
  for await (const _ of tracer.render({ samples, maxSubmitMs: 2000 }));
  const pixels = await tracer.read('beauty');
  tracer.destroy();
  return Array.from({ length: SIZE * SIZE }, (_, i) => pixels[4 * i]!);
}

/** Pixels that the quads' diagonal crosses, where samples meet two triangles. */
const onDiagonal = (i: number) => Math.abs(SIZE - 1 - (i % SIZE) - Math.floor(i / SIZE)) <= 1;

describe('opacity', () => {
  it('is met exactly by as many samples as its share is a part of', async () => {
    const pixels = await veils([0.25], 16);
    for (const [i, value] of pixels.entries()) if (!onDiagonal(i)) expect(value).toBeCloseTo(0.75, 6);
    // Nowhere far off: two triangles have sequences of their own.
    for (const value of pixels) expect(Math.abs(value - 0.75)).toBeLessThanOrEqual(0.25);
  });

  it('of one surface is independent of that of another', async () => {
    const samples = 64;
    const pixels = await veils([0.5, 0.5], samples);
    const mean = pixels.reduce((sum, value) => sum + value, 0) / pixels.length;
    // Within four standard errors of independent decisions, which these are spread more evenly than.
    expect(Math.abs(mean - 0.25)).toBeLessThan(4 * Math.sqrt((0.25 * 0.75) / (samples * pixels.length)));
    // And not the same decision at each pixel: that would leave a half, or nothing.
    for (const value of pixels) expect(Math.abs(value - 0.25)).toBeLessThan(0.2);
  });

  it.each(['sobol', 'blue-noise', 'independent'] as const)(
    'is independent of where in the pixel a sample lies: %s',
    async (sampler) => {
      // The right edge of the quad, of its first triangle, divides a column of pixels.
      const column = SIZE / 2;
      const pixels = await veils([0.5], 64, { sampler, seed: 0 }, 1 / SIZE - 4);
      const values = pixels.filter((_, i) => i % SIZE === column);
      const mean = values.reduce((sum, value) => sum + value, 0) / SIZE;
      expect(Math.abs(mean - 0.75)).toBeLessThan(4 * Math.sqrt((0.25 * 0.75) / (64 * SIZE)));
    },
  );

  it('is decided by other numbers with another seed', async () => {
    const [first, second] = [await veils([0.3], 4, { seed: 1 }), await veils([0.3], 4, { seed: 2 })];
    expect(first.filter((_, i) => !onDiagonal(i))).not.toEqual(second.filter((_, i) => !onDiagonal(i)));
  });

  it('is decided again where a path comes back to the same triangle', async () => {
    // To a mirror and back to the light through one veil.
    const pixels = await veils([0.5], 64, {}, 0, (scene) =>
      addQuad(scene, 4, -1, {
        name: 'mirror',
        parameters: { base_metalness: 1, base_color: [1, 1, 1], specular_roughness: 0 },
      }),
    );
    const values = pixels.filter((_, i) => !onDiagonal(i));
    const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
    expect(Math.abs(mean - 0.25)).toBeLessThan(4 * Math.sqrt((0.25 * 0.75) / (64 * values.length)));
  });

  it('is met on average by independent samples too', async () => {
    const samples = 64;
    const pixels = await veils([0.25], samples, { sampler: 'independent' });
    const mean = pixels.reduce((sum, value) => sum + value, 0) / pixels.length;
    expect(Math.abs(mean - 0.75)).toBeLessThan(4 * Math.sqrt((0.25 * 0.75) / (samples * pixels.length)));
  });

  it('of several surfaces is met exactly by as many samples as the product is a part of', async () => {
    // 3/4 · 1/2 · 1/2 = 3/16, of 16 samples on both sides of the diagonals.
    for (const value of await veils([0.25, 0.5, 0.5], 16)) expect(value).toBeCloseTo(3 / 16, 6);
  });

  it('of many surfaces shows each by what those before it let through', async () => {
    const samples = 1024;
    // Enough to need several numbers for a ray: most of what is left is a 4,000th.
    const stack = Array.from({ length: 24 }, (_, i) => ({
      opacity: 0.1 + 0.4 * (((7 * i) % 24) / 24),
      light: ((11 * i) % 24) / 24,
    }));
    const scene = createScene();
    for (const [i, { opacity, light }] of stack.entries())
      addQuad(scene, 4, -0.1 * i, {
        name: `veil ${i}`,
        parameters: {
          base_weight: 0,
          specular_weight: 0,
          geometry_opacity: opacity,
          // As much light from each, whatever is before it.
          emission_luminance: light / stack.slice(0, i).reduce((left, one) => left * (1 - one.opacity), opacity),
        },
      });
    const expected = stack.reduce((sum, { light }) => sum + light, 0);
    // One sample is one veil's light.
    const square = stack.reduce((sum, { light, opacity }, i) => {
      const chance = stack.slice(0, i).reduce((left, one) => left * (1 - one.opacity), opacity);
      return sum + light ** 2 / chance;
    }, 0);
    const pixels = await shown(scene, samples, {});
    const mean = pixels.reduce((sum, value) => sum + value, 0) / pixels.length;
    expect(Math.abs(mean - expected)).toBeLessThan(4 * Math.sqrt((square - expected ** 2) / (samples * pixels.length)));
  });
});

/** A matte floor below a light that shines through black quads, which the camera does not see. */
async function below(opacities: readonly number[], samples: number, add: (scene: Scene) => void = () => undefined) {
  const scene = createScene();
  addQuad(scene, 4, 0, lambert(0.5));
  opacities.forEach((geometry_opacity, i) =>
    addQuad(scene, 20, 4 + i, {
      name: `veil ${i}`,
      parameters: { base_color: [0, 0, 0], specular_weight: 0, geometry_opacity },
    }),
  );
  add(scene);
  scene.lights.push({ type: 'point', name: 'light', color: [1, 1, 1], intensity: 1000, position: [0, 0, 50] });
  return shown(scene, samples, { maxDepth: 2 });
}

describe('light samples', () => {
  it('are weakened by what surfaces let through, without noise', async () => {
    const [open, veiled] = [await below([], 1), await below([0.25, 0.5, 0.75], 1)];
    // The camera's ray is the same, so is everything but the factor of 3/4 · 1/2 · 1/4.
    for (const [i, value] of veiled.entries()) expect(value / open[i]! / (3 / 32)).toBeCloseTo(1, 5);
  });

  it.each([
    ['many surfaces', [0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5], () => undefined],
    // Smooth thin walls are passed one by one, and chance decides about opacity.
    [
      'glass between',
      [0.5, 0.75],
      (scene: Scene) =>
        addQuad(scene, 20, 4.5, {
          name: 'wall',
          parameters: {
            transmission_weight: 1,
            specular_weight: 0,
            specular_roughness: 0,
            geometry_thin_walled: true,
          },
        }),
    ],
  ] as const)('are weakened on average: %s', async (_, opacities, add) => {
    const samples = 1024;
    const [open, veiled] = [await below([], 1), await below(opacities, samples, add as (scene: Scene) => void)];
    const sum = (values: readonly number[]) => values.reduce((a, b) => a + b, 0);
    const passed = opacities.reduce((left, opacity) => left * (1 - opacity), 1);
    // Of independent decisions about everything.
    const error = Math.sqrt((passed * (1 - passed)) / (samples * veiled.length));
    expect(Math.abs(sum(veiled) / sum(open) - passed)).toBeLessThan(4 * error);
  });
});

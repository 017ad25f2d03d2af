import { buildBlas, type TreeBuilder } from '@glanz/bvh';
import { bestSplit } from '@glanz/bvh/best';
import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type HierarchyBuilder, type PathTracerOptions } from '../../src/index';
import { addQuad, camera, createScene } from '../scenes';
import { random } from '../tree-lights';

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

  it('is decided once where a tree has a triangle in several leaves', async () => {
    // Among small triangles, long and thin ones in all directions, which `bestSplit` cuts into pieces.
    const next = random(5);
    const between = (a: number, b: number) => a + (b - a) * next();
    const positions = new Float32Array(9 * 60);
    for (let t = 0; t < 60; t++)
      for (let k = 0; k < 3; k++) {
        const at = between(-0.9, 0.9);
        positions[9 * t + k] = at;
        positions[9 * t + 3 + k] = t < 12 ? between(-0.9, 0.9) : at + between(-0.1, 0.1);
        positions[9 * t + 6 + k] = positions[9 * t + 3 + k]! + between(0.05, 0.1);
      }
    const indices = Uint32Array.from({ length: 180 }, (_, i) => i);
    const film = async (builder?: TreeBuilder) => {
      let inLeaves = 0;
      const hierarchies: HierarchyBuilder = {
        buildBlas: async (mesh) => {
          const blas = buildBlas(mesh, builder && { builder });
          inLeaves = blas.triangleIndices.length;
          return blas;
        },
      };
      const pixels = await veils([], 64, { hierarchies, bvhBuilder: 'cpu' }, 0, (scene) => {
        addQuad(scene, 1, 0, { name: 'veil', parameters: { base_color: [0.2, 0.5, 0.8], geometry_opacity: 0.5 } });
        scene.meshes[0] = { name: 'needles', positions, indices };
      });
      return { pixels, inLeaves };
    };
    const [whole, cut] = [await film(), await film(bestSplit)];
    expect([whole.inLeaves, cut.inLeaves > 60]).toEqual([60, true]);
    expect(cut.pixels).toEqual(whole.pixels);
  });
});

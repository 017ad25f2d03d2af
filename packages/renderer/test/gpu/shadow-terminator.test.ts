import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Light, Scene } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { casesOf } from '../full';
import { addQuad, addSphere, createScene, lambert, middle } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

const SIZE = 32;
/** What the image shows of the window of the test's camera. */
const PART = 2 / 3;
const inner = middle(PART);

/** Green channel of an image. */
async function image(scene: Scene, options: Partial<PathTracerOptions> = {}, samples = 64): Promise<Float32Array> {
  const tracer = await PathTracer.create(device, scene, {
    width: SIZE,
    height: SIZE,
    camera: inner,
    maxDepth: 2,
    ...options,
  });
  for await (const progress of tracer.render({ samples })) void progress;
  const beauty = await tracer.read('beauty');
  tracer.destroy();
  return Float32Array.from({ length: SIZE * SIZE }, (_, i) => beauty[4 * i + 1]!);
}

/** A matt ball of so many segments around, with smooth normals, lit from the side. */
function ball(segments: number): Scene {
  const scene = createScene();
  addSphere(scene, 0.8, [0, 0, 0], lambert(1), segments);
  const sun: Light = {
    type: 'directional',
    name: 'sun',
    color: [1, 1, 1],
    intensity: 3,
    direction: [-0.96, -0.2, -0.2],
  };
  scene.lights.push(sun);
  return scene;
}

/** Pixels well inside of the ball's outline, whatever its polygon. */
const inside = [...Array(SIZE * SIZE).keys()].filter(
  (i) => Math.hypot((i % SIZE) + 0.5 - SIZE / 2, Math.floor(i / SIZE) + 0.5 - SIZE / 2) < 0.495 * SIZE,
);

const rms = (a: Float32Array, b: Float32Array) =>
  Math.sqrt(inside.reduce((sum, i) => sum + (a[i]! - b[i]!) ** 2, 0) / inside.length);
const mean = (a: Float32Array) => inside.reduce((sum, i) => sum + a[i]!, 0) / inside.length;

describe('a ball of few triangles with smooth normals', () => {
  it('is lit as one of many, without the edges of its triangles', async () => {
    const fine = await image(ball(192), { shadowTerminator: 'faceted' });
    for (const segments of casesOf(24, 16)) {
      const smooth = await image(ball(segments), { shadowTerminator: 'smooth' });
      const faceted = await image(ball(segments), { shadowTerminator: 'faceted' });
      // Its silhouette and interpolated normals still differ a little from the fine ball's.
      expect(rms(smooth, fine)).toBeLessThan(0.5 * rms(faceted, fine));
    }
  });

  it('comes to what Lambert says that a sphere sends back, by the square of its edges', async () => {
    // n · l over the middle of a sphere's disk, seen by the test's camera: by a ray through each of a grid of points.
    const { direction } = ball(8).lights[0] as Extract<Light, { type: 'directional' }>;
    const length = Math.hypot(...direction);
    const GRID = 8;
    let exact = 0;
    for (const i of inside) {
      for (let k = 0; k < GRID * GRID; k++) {
        const d = [
          PART * ((2 * ((i % SIZE) + ((k % GRID) + 0.5) / GRID)) / SIZE - 1),
          PART * (1 - (2 * (Math.floor(i / SIZE) + (Math.floor(k / GRID) + 0.5) / GRID)) / SIZE),
          -3,
        ] as const;
        const a = d[0] ** 2 + d[1] ** 2 + 9;
        // |(0, 0, 3) + t d| = 0.8.
        const t = (9 - Math.sqrt(81 - a * (9 - 0.64))) / a;
        const n = [t * d[0], t * d[1], 3 - 3 * t].map((c) => c / 0.8);
        exact +=
          Math.max(0, -(n[0]! * direction[0] + n[1]! * direction[1] + n[2]! * direction[2]) / length) /
          (GRID * GRID * inside.length);
      }
    }
    exact *= 3 / Math.PI;
    // 1.3 % with 16 segments: its normals are a sphere's, but its pixels lie elsewhere on it.
    for (const segments of [16, 32, 96]) {
      const smooth = mean(await image(ball(segments)));
      expect(Math.abs(smooth / exact - 1)).toBeLessThan(0.0005 + 0.015 * (16 / segments) ** 2);
    }
  });

  it('returns all light in a furnace, where faceted horizons lose some', async () => {
    const scene = createScene();
    addSphere(scene, 0.8, [0, 0, 0], lambert(1), 16);
    scene.environment = { type: 'constant', radiance: [1, 1, 1] };
    const smooth = await image(scene, { maxDepth: 8, shadowTerminator: 'smooth' });
    const faceted = await image(scene, { maxDepth: 8, shadowTerminator: 'faceted' });
    // White in white: exact but for paths that are too long or hit the ball again.
    expect(mean(faceted)).toBeLessThan(0.998);
    expect(mean(smooth)).toBeGreaterThan(0.9995);
    expect(Math.max(...inside.map((i) => smooth[i]!))).toBeLessThan(1 + 1e-5);
  });

  it('gives the same by light samples as by BSDF samples', async () => {
    // A lamp large enough for both: a glowing wall at the side, as a triangle light (light samples and BSDF samples)
    // and as a piece of a constant environment seen through a hole (BSDF samples alone).
    const lit = (emission: boolean) => {
      const scene = createScene();
      addSphere(scene, 0.8, [0, 0, 0], lambert(0.8), 16);
      const lamp = {
        name: 'lamp',
        double_sided: true,
        parameters: emission
          ? { base_weight: 0, specular_weight: 0, emission_color: [1, 1, 1] as const, emission_luminance: 4 }
          : { base_weight: 0, specular_weight: 0 },
      };
      addQuad(scene, 3, 0, lamp, { transform: [0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 4, 0, 0, 1] });
      return scene;
    };
    const both = await image(lit(true), { sampler: 'sobol' });
    const alone = lit(false);
    alone.environment = { type: 'constant', radiance: [4, 4, 4] };
    const all = createScene();
    addSphere(all, 0.8, [0, 0, 0], lambert(0.8), 16);
    all.environment = { type: 'constant', radiance: [4, 4, 4] };
    // Everything without what the dark wall hides is what the wall would give.
    // The standard error of the difference, over 16 seeds, is 0.43 % of `both` with 64 samples of each, 0.42 % of it from
    // `dimmed`: with four times the samples of that, about 0.24 %, less than a quarter of what is allowed.
    // All samples of the first are the same: nothing hides the environment from a convex ball.
    const [bright, dimmed] = [await image(all, {}, 16), await image(alone, {}, 256)];
    expect(Math.abs(mean(both) - (mean(bright) - mean(dimmed)))).toBeLessThan(0.01 * mean(both));
  });
});

describe('what has no smooth surface to stand for', () => {
  it('does not change: a box with averaged normals, and a hollow', async () => {
    const box = createScene();
    const corners = Array.from({ length: 8 }, (_, i) => [0, 1, 2].map((k) => ((i >> k) & 1 ? 0.5 : -0.5)));
    const faces = [
      [0, 4, 6, 2],
      [1, 3, 7, 5],
      [0, 1, 5, 4],
      [2, 6, 7, 3],
      [0, 2, 3, 1],
      [4, 5, 7, 6],
    ] as const;
    box.meshes.push({
      name: 'box',
      positions: Float32Array.from(corners.flat()),
      normals: Float32Array.from(corners.flat(), (x) => x * (2 / Math.sqrt(3))),
      indices: Uint32Array.from(faces.flatMap(([a, b, c, d]) => [a, b, c, a, c, d])),
    });
    box.materials.push(lambert(0.8));
    box.instances.push({
      name: 'box',
      mesh: 0,
      material: 0,
      transform: [0.8, 0, 0.6, 0, 0, 1, 0, 0, -0.6, 0, 0.8, 0, 0, 0, 0, 1],
    });
    box.lights.push(...ball(8).lights);
    const hollow = ball(16);
    // Inside out: the camera sees the far half from within.
    hollow.instances[0]!.transform = [4.5, 0, 0, 0, 0, 4.5, 0, 0, 0, 0, 4.5, 0, 0, 0, 0, 1];
    hollow.lights.splice(0, 1, { type: 'point', name: 'lamp', color: [1, 1, 1], intensity: 5, position: [0, 0, 0] });
    for (const scene of [box, hollow]) {
      expect(await image(scene, { shadowTerminator: 'smooth' }, 16)).toEqual(
        await image(scene, { shadowTerminator: 'faceted' }, 16),
      );
    }
  });
});

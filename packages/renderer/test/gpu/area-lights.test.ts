import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Light, Material, Scene } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { casesOf } from '../full';
import { addBox, addQuad, camera, createScene, lambert, meanOf } from '../scenes';

type Vector = readonly [number, number, number];

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});
afterAll(() => expectNoGpuErrors());

const SIZE = process.env['GLANZ_FULL'] === undefined ? 8 : 16;

async function image(scene: Scene, samples: number, options: Partial<PathTracerOptions> = {}): Promise<Float32Array> {
  const tracer = await PathTracer.create(device, scene, { width: SIZE, height: SIZE, camera, ...options });
  try {
    for await (const progress of tracer.render({ samples })) void progress;
    return await tracer.read('beauty');
  } finally {
    tracer.destroy();
  }
}

const mean = (pixels: Float32Array) => meanOf(pixels, SIZE, 0, 0, SIZE, SIZE);

/** Sees only what lies at the origin, at an angle from the side, from 2 m away. */
const narrow = (() => {
  const [c, s] = [Math.cos(0.9), Math.sin(0.9)];
  return { ...camera, transform: [0, 1, 0, 0, -c, 0, s, 0, s, 0, c, 0, 2 * s, 0, 2 * c, 1], yfov: 1e-3 };
})();

const white = { name: 'light', color: [1, 0.5, 0.25] as Vector, intensity: 4 };

/** Irradiance of a polygon at the origin with the normal +z (Lambert's formula), all of it above the horizon. */
function polygonIrradiance(points: readonly Vector[]): number {
  let sum = 0;
  points.forEach((p, i) => {
    const q = points[(i + 1) % points.length]!;
    const [a, b] = [p, q].map((v) => v.map((c) => c / Math.hypot(...v))) as [number[], number[]];
    const cross = [a[1]! * b[2]! - a[2]! * b[1]!, a[2]! * b[0]! - a[0]! * b[2]!, a[0]! * b[1]! - a[1]! * b[0]!];
    const length = Math.hypot(...cross);
    if (length > 0) sum += (Math.atan2(length, a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!) * cross[2]!) / length;
  });
  return Math.abs(sum) / 2;
}

describe('lights with a size', () => {
  const corners = (position: Vector, x: Vector, y: Vector): Vector[] =>
    (
      [
        [-1, -1],
        [1, -1],
        [1, 1],
        [-1, 1],
      ] as const
    ).map(([a, b]) => position.map((p, k) => p + 0.5 * (a * x[k]! + b * y[k]!)) as unknown as Vector);
  const cases: [string, Light, number][] = [
    [
      'a rectangle',
      {
        ...white,
        type: 'rectangle',
        position: [0.4, 0.3, 0.7],
        direction: [0, 0, -1],
        tangent: [0, 1, 0],
        width: 0.8,
        height: 0.3,
      },
      polygonIrradiance(corners([0.4, 0.3, 0.7], [0, 0.8, 0], [0.3, 0, 0])),
    ],
    [
      'a rectangle so close that it fills the sky',
      { ...white, type: 'rectangle', position: [0, 0, 0.05], direction: [0, 0, -1], width: 10, height: 10 },
      polygonIrradiance(corners([0, 0, 0.05], [10, 0, 0], [0, 10, 0])),
    ],
    [
      'a rectangle too small for its solid angle',
      { ...white, type: 'rectangle', position: [0.4, 0.3, 4], direction: [0, 0, -1], width: 0.02, height: 0.01 },
      polygonIrradiance(corners([0.4, 0.3, 4], [0.02, 0, 0], [0, 0.01, 0])),
    ],
    // Level along z × x: the width lies along y when the light faces −x, slanted down here.
    [
      'a slanted rectangle',
      {
        ...white,
        type: 'rectangle',
        position: [1, 0, 1.2],
        direction: [-0.6, 0, -0.8],
        tangent: [0, 1, 0],
        width: 1.5,
        height: 0.5,
      },
      polygonIrradiance(corners([1, 0, 1.2], [0, 1.5, 0], [0.8 * 0.5, 0, -0.6 * 0.5])),
    ],
    // A disk that faces the point: π sin² of half its angle.
    [
      'a disk',
      { ...white, type: 'disk', position: [0, 0, 0.5], direction: [0, 0, -2], radius: 0.4 },
      (Math.PI * 0.4 ** 2) / (0.4 ** 2 + 0.5 ** 2),
    ],
    ['a sphere', { ...white, type: 'sphere', position: [0.6, 0, 0.8], radius: 0.5 }, Math.PI * 0.5 ** 2 * 0.8],
    [
      'a sphere as small as a point',
      { ...white, type: 'sphere', position: [0.6, 0, 0.8], radius: 1e-3 },
      Math.PI * 1e-6 * 0.8,
    ],
  ];
  it.each(cases)('%s lights a matte floor as its form factor says', async (_, light, form) => {
    for (const lightSampling of ['tree', 'power'] as const) {
      const scene = createScene();
      addQuad(scene, 20, 0, lambert(0.5));
      // With a second one there is a choice to be made.
      scene.lights.push({ ...light, visible: false } as Light, {
        type: 'point',
        name: 'point',
        color: [1, 1, 1],
        intensity: 0.2,
        position: [0, 0, 1],
      });
      const seen = mean(await image(scene, 256, { camera: narrow, maxDepth: 2, lightSampling }));
      light.color.forEach((c, k) => {
        const expected = (0.5 / Math.PI) * (4 * c * form + 0.2);
        expect(Math.abs(seen[k]! / expected - 1)).toBeLessThan(0.01);
      });
    }
  });

  it('are seen as they are, from the side that shines, unless they are hidden; glass and mirrors show them all the same', async () => {
    const flat = { ...white, type: 'rectangle', position: [0, 0, 0], width: 4, height: 4 } as const;
    const seen = async (light: Light, extra?: (scene: Scene) => void, maxDepth = 8) => {
      const scene = createScene();
      addQuad(scene, 5, -1, lambert(0));
      scene.lights.push(light);
      extra?.(scene);
      return mean(await image(scene, 64, { maxDepth }))[0];
    };
    expect(await seen({ ...flat, direction: [0, 0, 1] })).toBeCloseTo(4, 5);
    expect(await seen({ ...flat, direction: [0, 0, -1] })).toBe(0);
    expect(await seen({ ...flat, direction: [0, 0, 1], visible: false })).toBe(0);
    // It blocks nothing: another behind it shines through.
    expect(
      await seen({ ...flat, direction: [0, 0, 1] }, (scene) =>
        scene.lights.push({ ...flat, name: 'behind', position: [0, 0, -0.5], direction: [0, 0, 1], intensity: 3 }),
      ),
    ).toBeCloseTo(7, 4);
    // A mirror shows the hidden one.
    const mirror: Material = {
      name: 'mirror',
      parameters: { base_metalness: 1, base_color: [1, 1, 1], specular_roughness: 0 },
    };
    expect(
      await seen(
        { ...flat, position: [0, 0, 3.5], width: 40, height: 40, direction: [0, 0, -1], visible: false },
        (scene) => addQuad(scene, 5, 0, mirror),
      ),
    ).toBeCloseTo(4, 4);
  });

  it.each(casesOf(0.05, 0.3, 0.8))(
    'on a glossy floor of roughness %f: the image of an emissive mesh in their place',
    async (specular_roughness) => {
      const floor: Material = {
        name: 'metal',
        parameters: { base_metalness: 1, base_color: [0.9, 0.6, 0.3], specular_roughness },
      };
      const base = () => {
        const scene = createScene();
        addQuad(scene, 20, 0, floor);
        return scene;
      };
      const analytic = base();
      analytic.lights.push({
        ...white,
        color: [1, 1, 1],
        type: 'rectangle',
        position: [0, 0, 2],
        direction: [0, 0, -1],
        width: 1,
        height: 1,
        visible: false,
      });
      const mesh = base();
      addQuad(
        mesh,
        0.5,
        2,
        { name: 'e', parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 4 } },
        { flip: true },
      );
      // From the side, so that the mesh is not in the view.
      const [c, s] = [Math.cos(0.6), Math.sin(0.6)];
      const side = { ...camera, transform: [0, 1, 0, 0, -c, 0, s, 0, s, 0, c, 0, 1.9 * s, 0, 1.9 * c, 1], yfov: 0.6 };
      const runs = async (scene: Scene) => {
        const values: number[] = [];
        for (let seed = 0; seed < 6; seed++)
          values.push(mean(await image(scene, 128, { camera: side, seed, maxDepth: 3, sampler: 'independent' }))[0]);
        const average = values.reduce((a, b) => a + b) / values.length;
        return {
          average,
          variance: values.reduce((sum, v) => sum + (v - average) ** 2, 0) / (values.length - 1) / values.length,
        };
      };
      const [a, b] = [await runs(analytic), await runs(mesh)];
      expect(Math.abs(a.average - b.average)).toBeLessThan(4.5 * Math.sqrt(a.variance + b.variance));
      expect(Math.sqrt(a.variance + b.variance) / b.average).toBeLessThan(0.02);
    },
  );

  it('in a block of absorbing matter they are dimmed on the way, found by light samples or by chance', async () => {
    const matter: Material = {
      name: 'matter',
      parameters: {
        specular_ior: 1,
        transmission_weight: 1,
        transmission_depth: 1,
        transmission_color: [Math.exp(-0.5), Math.exp(-1), Math.exp(-2)],
      },
    };
    const scene = createScene();
    addBox(scene, [-3, -3, -1], [3, 3, 1], matter);
    scene.lights.push({
      ...white,
      color: [1, 1, 1],
      type: 'rectangle',
      position: [0, 0, 0],
      direction: [0, 0, 1],
      width: 2.5,
      height: 2.5,
    });
    const seen = meanOf(await image(scene, 16), SIZE, (3 * SIZE) / 8, (3 * SIZE) / 8, (5 * SIZE) / 8, (5 * SIZE) / 8);
    // 1 m of it, but for the slant of the view.
    [0.5, 1, 2].forEach((a, k) => expect(Math.abs(seen[k]! / (4 * Math.exp(-a)) - 1)).toBeLessThan(0.02));
  });

  it('are edited like the others', async () => {
    const scene = createScene();
    addQuad(scene, 20, 0, lambert(0.5));
    scene.lights.push({ ...white, type: 'sphere', position: [0.6, 0, 0.8], radius: 0.5, visible: false });
    const tracer = await PathTracer.create(device, scene, { width: SIZE, height: SIZE, camera: narrow, maxDepth: 2 });
    await tracer.setLight('light', { radius: 0.25, intensity: 8 });
    for await (const progress of tracer.render({ samples: 256 })) void progress;
    const seen = mean(await tracer.read('beauty'));
    expect(Math.abs(seen[0] / ((0.5 / Math.PI) * 8 * Math.PI * 0.25 ** 2 * 0.8) - 1)).toBeLessThan(0.01);
    await expect(tracer.setLight('light', { radius: 0 })).rejects.toThrow(/above 0/);
    tracer.destroy();
  });
});

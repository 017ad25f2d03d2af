import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Light, Material, PerspectiveCamera, Scene } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { filmStatistics, finishedFilm } from '../film-statistics';
import { addQuad, addSphere, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

const SIZE = 12;

/** A camera at (0, y, z) that looks at a point of the floor, (0, at, 0). */
function looking(y: number, z: number, at: number, yfov: number): PerspectiveCamera {
  const length = Math.hypot(y - at, z);
  const [c, s] = [z / length, (at - y) / length];
  return { type: 'perspective', name: 'camera', transform: [1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, 0, y, z, 1], yfov };
}

/** Below the ball: its shadow, with what it focuses there. */
const below = looking(-2.5, 0.8, 0, 0.2);

const placed = (x: number, y: number, z: number) => [1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, x, y, z, 1];

const glass = (parameters: Material['parameters'] = {}): Material => ({
  name: 'glass',
  parameters: { base_weight: 0, transmission_weight: 1, specular_roughness: 0, ...parameters },
});

const mirror: Material = {
  name: 'mirror',
  parameters: { base_metalness: 1, base_color: [0.9, 0.8, 0.7], specular_roughness: 0 },
};

const glow = (emission_luminance: number): Material => ({
  name: 'light',
  parameters: { base_weight: 0, specular_weight: 0, emission_luminance },
});

/** A ball with smooth normals over a floor, without a light. */
function ball(material: Material, segments = 24): Scene {
  const scene = createScene();
  addQuad(scene, 2, 0, lambert(0.7));
  addSphere(scene, 0.4, [0, 0, 0.6], material, segments);
  return scene;
}

/** The same below a small light that looks down. */
function lit(material: Material): Scene {
  const scene = ball(material);
  addQuad(scene, 0.15, 0, glow(40), { transform: placed(0.1, 0.1, 2.2) });
  return scene;
}

/**
 * Below a sheet of glass whose normals differ from its triangles' at the upper side, where a large light shines on it
 * from the other side. All light that passes is multiplied by the factor of shading normals: without it there would be
 * 7 % more.
 */
function belowTilted(): Scene {
  const scene = createScene();
  addQuad(scene, 2, 0, lambert(0.7));
  const [sine, cosine] = [Math.sin(0.35), Math.cos(0.35)];
  const material = addQuad(scene, 1, 0.8, glass());
  scene.meshes.at(-1)!.normals = Float32Array.from({ length: 12 }, (_, i) => [0, -sine, cosine][i % 3]!);
  addQuad(scene, 1, 0.6, glass(), { flip: true });
  scene.instances.at(-1)!.material = material;
  const [s, c] = [0.7, 1.4].map((side) => side / Math.hypot(0.7, 1.4)) as [number, number];
  addQuad(scene, 0.6, 0, glow(2.5), { transform: [1, 0, 0, 0, 0, -c, s, 0, 0, -s, -c, 0, 0, 0.7, 2.2, 1] });
  return scene;
}

/** The ball in an environment with a sun. */
function sunny(material: Material): Scene {
  const scene = ball(material);
  const [width, height] = [16, 8];
  const data = new Float32Array(3 * width * height).fill(0.2);
  data.set([600, 500, 400], 3 * (3 * width + 11));
  scene.environment = { type: 'latlong', width, height, data };
  return scene;
}

/** Behind a smooth thin wall, which light samples pass. */
function behindPane(): Scene {
  const scene = lit(glass());
  addQuad(scene, 1, 1.3, glass({ geometry_thin_walled: true }));
  return scene;
}

const LIGHTS: readonly Light[] = [
  {
    type: 'disk',
    name: 'disk',
    position: [0.1, 0.1, 2.2],
    direction: [0, 0, -1],
    radius: 0.15,
    color: [1, 1, 1],
    intensity: 2,
  },
  { type: 'sphere', name: 'sphere', position: [-0.4, 0.1, 2], radius: 0.1, color: [1, 0.2, 1], intensity: 2 },
  {
    type: 'rectangle',
    name: 'rectangle',
    position: [0.1, -0.3, 1.6],
    direction: [0, 0.2, -1],
    width: 0.1,
    height: 0.3,
    color: [0.2, 1, 1],
    intensity: 2,
  },
];

async function tracerOf(scene: Scene, options: Partial<PathTracerOptions>): Promise<PathTracer> {
  return PathTracer.create(device, scene, { width: SIZE, height: SIZE, camera: below, maxDepth: 4, ...options });
}

const film = async (scene: Scene, samples: number, options: Partial<PathTracerOptions>) =>
  finishedFilm(await tracerOf(scene, options), samples);

const SAMPLES = 32;

const measure = (scene: Scene, options: Partial<PathTracerOptions>, samples = SAMPLES) =>
  filmStatistics((seed) => film(scene, samples, { ...options, seed }));

describe('PathTracer with light paths', () => {
  const colored = {
    transmission_color: [0.9, 0.3, 0.2],
    transmission_depth: 0.5,
    transmission_dispersion_scale: 1,
    transmission_dispersion_abbe_number: 20,
  } as const;
  const lens: PerspectiveCamera = { ...below, lens_radius: 0.1, focus_distance: 2.4 };
  const cases: readonly (readonly [string, Scene, Partial<PathTracerOptions>, number?])[] = [
    ['glass with tilted normals', belowTilted(), { camera: looking(-2.5, 0.4, 0, 0.2) }, 4 * SAMPLES],
    [
      'a mirror and a sun',
      sunny(mirror),
      { shadowTerminator: 'faceted', maxDepth: 3, camera: looking(-2, 2, -0.3, 0.3) },
    ],
    ['a glass ball and a sun', sunny(glass()), { camera: looking(-2, 1.2, 0, 0.6) }],
    ['a thin wall, with a guide', behindPane(), { guiding: 0.001 }],
    ['dispersion and absorption', lit(glass(colored)), {}],
    [
      'lights with a size, a lens and a filter',
      { ...ball(glass()), lights: [...LIGHTS] },
      { lightGroups: 'each', camera: lens, filter: 'gaussian' },
    ],
  ];
  for (const [name, scene, options, samples] of cases)
    it(`leaves the mean as it is: ${name}`, async () => {
      const plain = await measure(scene, options, samples);
      const few = await measure(scene, { ...options, lightPaths: 0.0625 }, samples);
      const many = await measure(scene, { ...options, lightPaths: 1 }, samples);
      expect(plain.mean).toBeGreaterThan(0);
      // Six standard errors, each estimated from 8 films: by chance once in 30,000. Of the tilted normals, the factor that
      // they stand for is ten.
      expect(Math.abs(many.mean - plain.mean)).toBeLessThan(6 * Math.hypot(many.error, plain.error));
      // With few light paths most of the weight is the path tracer's, with many it is theirs: an error of either shows.
      expect(Math.abs(few.mean - plain.mean)).toBeLessThan(6 * Math.hypot(few.error, plain.error));
      expect(Math.abs(many.mean - few.mean)).toBeLessThan(6 * Math.hypot(many.error, few.error));
    });

  it('takes nearly all noise of a caustic away', async () => {
    const scene = lit(glass());
    const [plain, some] = [await measure(scene, {}), await measure(scene, { lightPaths: 0.25 })];
    expect(some.noise).toBeLessThan(0.05 * plain.noise);
  });

  it('gives the same film, bit for bit, however it is cut into batches', async () => {
    const scene = { ...lit(glass()), lights: [...LIGHTS] };
    const options = { lightPaths: 0.5, width: 40, height: 30 };
    const whole = await film(scene, 5, options);
    // A part of the image at once, so that each batch traces all light paths of its sample.
    expect(await film(scene, 5, { ...options, pathsInFlight: 128 })).toEqual(whole);
    const tracer = await tracerOf(scene, options);
    for (const samples of [1, 2, 5]) for await (const _ of tracer.render({ samples }));
    expect(await tracer.read('beauty')).toEqual(whole);
    tracer.destroy();
  });

  it('follows edits and sizes', async () => {
    const options = { lightPaths: 0.5 };
    const whole = await film(lit(glass()), 4, options);
    const scene = lit(glass());
    const moved = scene.instances[1]!.transform;
    const start = {
      ...scene,
      instances: scene.instances.map((instance, i) =>
        i === 1 ? { ...instance, transform: [...Array.from(moved).slice(0, 12), 0.5, 0.3, 0.2, 1] } : instance,
      ),
    };
    const tracer = await tracerOf(start, { ...options, width: 2 * SIZE, height: 8 });
    for await (const _ of tracer.render({ samples: 2 }));
    await tracer.setInstanceTransform(1, moved);
    await tracer.resize(SIZE, SIZE);
    for await (const _ of tracer.render({ samples: 4 }));
    expect(await tracer.read('beauty')).toEqual(whole);
    tracer.destroy();
  });

  it('leaves images without caustics as they are, bit for bit', async () => {
    const scene = lit(lambert(0.5));
    expect(await film(scene, 4, { lightPaths: 1 })).toEqual(await film(scene, 4, {}));
  });

  it('has no effect with cameras and options that it does not know', async () => {
    const scene = lit(glass());
    for (const options of [
      { clampIndirect: 5 },
      { caustics: false },
      { camera: { ...below, type: 'panorama' } as never },
    ])
      expect(await film(scene, 2, { ...options, lightPaths: 1 })).toEqual(await film(scene, 2, options));
  });
});

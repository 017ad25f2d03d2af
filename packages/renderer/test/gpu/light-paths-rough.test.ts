import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Light, Material, PerspectiveCamera, Scene } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { filmStatistics, finishedFilm, mean } from '../film-statistics';
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

/** The floor beside the ball, on the side that the light comes from. */
const beside = looking(-2.5, 2, -0.65, 0.3);

const gold = (specular_roughness: number, parameters: Material['parameters'] = {}): Material => ({
  name: 'gold',
  parameters: { base_metalness: 1, base_color: [0.95, 0.7, 0.3], specular_roughness, ...parameters },
});

const glow = (emission_luminance: number): Material => ({
  name: 'light',
  parameters: { base_weight: 0, specular_weight: 0, emission_luminance },
});

/** A ball with smooth normals over a floor, without a light. */
function ball(material: Material, segments = 24): Scene {
  const scene = createScene();
  addQuad(scene, 2, 0, lambert(0.7));
  addSphere(scene, 0.3, [0, 0, 0.35], material, segments);
  return scene;
}

/** In an environment with a sun. */
function sunny(scene: Scene): Scene {
  const [width, height] = [64, 32];
  const data = new Float32Array(3 * width * height).fill(0.2);
  data.set([9000, 8000, 7000], 3 * (12 * width + 46));
  scene.environment = { type: 'latlong', width, height, data };
  return scene;
}

/** Below a small emissive square, aslant. */
function lit(scene: Scene): Scene {
  const s = Math.SQRT1_2;
  addQuad(scene, 0.1, 0, glow(200), { transform: [1, 0, 0, 0, 0, -s, s, 0, 0, -s, -s, 0, 0, -1.6, 1.9, 1] });
  return scene;
}

const lights = (...list: readonly Light[]) => [...list];

const DIRECTIONAL: Light = {
  type: 'directional',
  name: 'sun',
  direction: [0.1, 0.7, -0.7],
  color: [1, 0.9, 0.8],
  intensity: 3,
};

const PUNCTUAL: readonly Light[] = [
  { type: 'point', name: 'point', position: [0.3, -1.6, 1.2], color: [1, 0.3, 0.2], intensity: 3 },
  {
    type: 'spot',
    name: 'spot',
    position: [-0.4, -1.5, 1.5],
    direction: [0.25, 0.8, -0.6],
    inner_cone_angle: 0.1,
    outer_cone_angle: 0.35,
    color: [0.2, 0.4, 1],
    intensity: 8,
  },
];

const SIZED: readonly Light[] = [
  {
    type: 'disk',
    name: 'disk',
    position: [0.1, -1.6, 1.6],
    direction: [0, 0.7, -0.7],
    radius: 0.1,
    color: [1, 1, 1],
    intensity: 60,
  },
  { type: 'sphere', name: 'sphere', position: [-0.4, -1.5, 1.5], radius: 0.1, color: [1, 0.2, 1], intensity: 40 },
  {
    type: 'rectangle',
    name: 'rectangle',
    position: [0.4, -1.3, 1.4],
    direction: [-0.2, 0.7, -0.7],
    width: 0.1,
    height: 0.3,
    color: [0.2, 1, 1],
    intensity: 60,
  },
];

async function tracerOf(scene: Scene, options: Partial<PathTracerOptions>): Promise<PathTracer> {
  return PathTracer.create(device, scene, { width: SIZE, height: SIZE, camera: beside, maxDepth: 3, ...options });
}

const film = async (scene: Scene, samples: number, options: Partial<PathTracerOptions>) =>
  finishedFilm(await tracerOf(scene, options), samples);

const SAMPLES = 64;

const measure = (scene: Scene, options: Partial<PathTracerOptions>) =>
  filmStatistics((seed) => film(scene, SAMPLES, { ...options, seed }));

describe('PathTracer with light paths by way of rough metals', () => {
  const cases: readonly (readonly [string, Scene, Partial<PathTracerOptions>, number])[] = [
    ['an environment with a sun', sunny(ball(gold(0.25))), {}, 0.2],
    ['a directional light', { ...ball(gold(0.2)), lights: lights(DIRECTIONAL) }, {}, 0.2],
    ['a small emissive square and a coarse ball', lit(ball(gold(0.15), 8)), { maxDepth: 4 }, 0.5],
    ['a coated ball, with a guide', sunny(ball(gold(0.3, { coat_weight: 1 }))), { guiding: 0.001 }, 0.5],
    ['point and spot lights', { ...ball(gold(0.3)), lights: lights(...PUNCTUAL, DIRECTIONAL) }, {}, 0.5],
    [
      'lights with a size, groups and a filter',
      { ...ball(gold(0.2)), lights: lights(...SIZED) },
      { lightGroups: 'each', filter: 'gaussian' },
      0.5,
    ],
  ];
  for (const [name, scene, options, share] of cases)
    it(`leaves the mean as it is, with less noise: ${name}`, async () => {
      const plain = await measure(scene, options);
      const few = await measure(scene, { ...options, lightPaths: 0.0625 });
      const many = await measure(scene, { ...options, lightPaths: 1 });
      expect(plain.mean).toBeGreaterThan(0);
      // Six standard errors, each estimated from 8 films: by chance once in 30,000. With few light paths most of the
      // weight is the path tracer's, with many it is theirs: an error of either shows.
      expect(Math.abs(many.mean - plain.mean)).toBeLessThan(6 * Math.hypot(many.error, plain.error));
      expect(Math.abs(few.mean - plain.mean)).toBeLessThan(6 * Math.hypot(few.error, plain.error));
      expect(Math.abs(many.mean - few.mean)).toBeLessThan(6 * Math.hypot(many.error, few.error));
      expect(many.noise).toBeLessThan(share * plain.noise);
    });

  it('adds no caustics of lights without a size, which the path tracer does not have', async () => {
    const scene = { ...ball(gold(0.3)), lights: lights(...PUNCTUAL, DIRECTIONAL) };
    addSphere(scene, 0.25, [0.3, -0.6, 0.8], {
      name: 'glass',
      parameters: { base_weight: 0, transmission_weight: 1, specular_roughness: 0 },
    });
    const [plain, many] = [await measure(scene, { maxDepth: 4 }), await measure(scene, { maxDepth: 4, lightPaths: 1 })];
    // Six standard errors, as above.
    expect(Math.abs(many.mean - plain.mean)).toBeLessThan(6 * Math.hypot(many.error, plain.error));
    expect(many.noise).toBeLessThan(plain.noise);
  });

  it('gives the same film, bit for bit, however it is cut into batches', async () => {
    const scene = { ...sunny(ball(gold(0.25))), lights: lights(DIRECTIONAL, ...SIZED) };
    const options = { lightPaths: 0.5, width: 40, height: 30 };
    const whole = await film(scene, 5, options);
    // A part of the image at once, so that each batch traces all light paths of its sample.
    expect(await film(scene, 5, { ...options, pathsInFlight: 128 })).toEqual(whole);
  });

  it('renders with kernels that reuse light samples, too', async () => {
    const tracer = await tracerOf(lit(ball(gold(0.2))), { lightPaths: 0.5 });
    for await (const _ of tracer.render({ samples: 2 }));
    await tracer.setLightReuse(true);
    for (let frame = 0; frame < 2; frame++) {
      tracer.reset({ lightReuse: true });
      for await (const _ of tracer.render({ samples: 2 }));
    }
    expect(tracer.statistics.badSamples).toBe(0);
    expect(mean([...(await tracer.read('beauty'))])).toBeGreaterThan(0);
    tracer.destroy();
  });

  it('leaves images as they are, bit for bit, where rough metals reflect none', async () => {
    const textured = sunny(ball({ ...gold(0.25), textures: { base_color: { texture: 0, channels: 'rgb' } } }));
    textured.images.push({ name: 'gold', width: 1, height: 1, data: new Uint8Array([240, 180, 80, 255]) });
    textured.textures.push({ image: 0, color_space: 'srgb' });
    const behindPane = sunny(ball(gold(0.25)));
    addQuad(behindPane, 1, 1.3, {
      name: 'pane',
      parameters: { base_weight: 0, transmission_weight: 1, specular_roughness: 0, geometry_thin_walled: true },
    });
    for (const scene of [sunny(ball(gold(0.6))), behindPane, textured])
      expect(await film(scene, 4, { lightPaths: 1 })).toEqual(await film(scene, 4, {}));
    // The last edge that is allowed ends at the metal.
    const rough = sunny(ball(gold(0.25)));
    expect(await film(rough, 4, { lightPaths: 1, maxDepth: 2 })).toEqual(await film(rough, 4, { maxDepth: 2 }));
  });
});

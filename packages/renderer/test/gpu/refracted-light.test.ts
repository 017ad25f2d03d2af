import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Light, Material, PerspectiveCamera, Scene } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { filmStatistics, finishedFilm } from '../film-statistics';
import { samplesOf } from '../full';
import { addBox, addQuad, addSphere, camera, createScene, lambert, middle } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

const SIZE = 6;
const ETA = 1.33;

const milk = (anisotropy = 0, depth = 0.3, parameters: Material['parameters'] = {}): Material => ({
  name: 'milk',
  parameters: {
    base_weight: 0,
    transmission_weight: 1,
    specular_ior: ETA,
    specular_roughness: 0,
    transmission_depth: depth,
    transmission_color: [0.4, 0.3, 0.2],
    transmission_scatter: [0.6, 0.8, 1],
    transmission_scatter_anisotropy: anisotropy,
    ...parameters,
  },
});

const glow = (emission_luminance: number): Material => ({
  name: 'light',
  parameters: { base_weight: 0, specular_weight: 0, emission_luminance },
});

/** A cube, turned, below a board that hides a part of the light. */
function cube(material: Material): Scene {
  const scene = createScene();
  addQuad(scene, 0.3, 0, lambert(0.5), { transform: [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, -0.3, 0.7, 0.1, 1] });
  addBox(scene, [-0.5, -0.5, -0.5], [0.5, 0.5, 0.5], material);
  const [c, s] = [Math.cos(0.5), Math.sin(0.5)];
  scene.instances.at(-1)!.transform = [c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0, 0, 0, 1];
  return scene;
}

function withLight(material: Material, light: Light): Scene {
  const scene = cube(material);
  scene.lights.push(light);
  return scene;
}

const white = [1, 1, 1] as const;

const rectangle = (scale = 1): Scene =>
  withLight(milk(), {
    type: 'rectangle',
    name: 'rectangle',
    position: [0.3, 1.6, 1],
    direction: [-0.1, -0.8, -0.6],
    width: 1.6 * scale,
    height: 1.4 * scale,
    color: white,
    intensity: 2,
  });

const sphere = (): Scene =>
  withLight(milk(), {
    type: 'sphere',
    name: 'sphere',
    position: [0.4, 1.4, 1],
    radius: 0.6,
    color: white,
    intensity: 4,
  });

/** Emissive triangles over the cube. */
const quad = (): Scene => {
  const scene = cube(milk(0.6));
  addQuad(scene, 0.8, 0, glow(3), { transform: [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0.2, 1.3, 0.2, 1] });
  return scene;
};

/** A small sun in a dim sky. */
const sun = (): Scene => {
  const scene = cube(milk(0.3));
  const [width, height] = [32, 16];
  const data = new Float32Array(3 * width * height).fill(0.05);
  for (let y = 2; y < 6; y++) data.fill(8, 3 * (y * width + 21), 3 * (y * width + 25));
  scene.environment = { type: 'latlong', width, height, data };
  return scene;
};

/** A limit that no path reaches, and with which no light sample is bent. */
const UNBENT: Partial<PathTracerOptions> = { maxBounces: { transmission: 127 } };

const statistics = (scene: Scene, samples: number, options: Partial<PathTracerOptions> = {}) =>
  filmStatistics(async (seed) =>
    finishedFilm(
      await PathTracer.create(device, scene, {
        width: SIZE,
        height: SIZE,
        camera: middle(0.55),
        seed,
        maxDepth: 12,
        ...options,
      }),
      samples,
    ),
  );

/** The same means, by less noise. */
async function expectSame(
  scene: Scene,
  quieter: number,
  options: Partial<PathTracerOptions> = {},
  samples = samplesOf(96, 4),
): Promise<void> {
  const bent = await statistics(scene, samples, options);
  const straight = await statistics(scene, samples, { ...options, ...UNBENT });
  const error = Math.hypot(bent.error, straight.error);
  expect(Math.abs(bent.mean - straight.mean), `${bent.mean} ${straight.mean} ± ${error}`).toBeLessThan(4 * error);
  expect(error).toBeLessThan(0.05 * straight.mean);
  expect(bent.noise * quieter, `${bent.noise} ${straight.noise}`).toBeLessThan(straight.noise);
}

describe('light samples for media behind smooth glass', () => {
  it('give the image that paths find by chance, with less noise: emissive triangles', () => expectSame(quad(), 2));
  it('a rectangle', () => expectSame(rectangle(), 2));
  it('a sphere', () => expectSame(sphere(), 2));
  it('a small sun in the environment', () => expectSame(sun(), 2));

  it('also where a path has few edges or events', async () => {
    await expectSame(rectangle(), 2, { maxDepth: 3, maxVolumeDepth: 2 });
  });

  it('through smooth normals and out of interiors in others paths find light by chance alone', async () => {
    // A large light is found with fewer samples. Both scenes have all shapes, and the same programs, but see one of them.
    const core = milk(0, 1, { specular_ior: 1.5 });
    const smooth = rectangle(2.7);
    smooth.instances.pop();
    addSphere(smooth, 0.5, [0, 0, 0], milk(), 16);
    // Where all shapes are curved, there would be no light samples at all.
    addBox(smooth, [3, 3, -3], [6, 6, 0], milk());
    addBox(smooth, [4, 4, -2], [5, 5, -1], core);
    await expectSame(smooth, 0.3);
    const nested = rectangle(2.7);
    addBox(nested, [-0.2, -0.2, -0.3], [0.2, 0.2, 0.3], core);
    addSphere(nested, 0.1, [4, 4, -2], milk(), 16);
    await expectSame(nested, 0.3);
  });
});

describe('lights without a size light media behind smooth glass', () => {
  /** Looks straight down at a half space below z = 0. */
  const narrow: PerspectiveCamera = { ...camera, yfov: 1e-3 };
  const [SCATTERING, ABSORPTION, G] = [3, 1, 0.6];
  const half = (light: Light): Scene => {
    const scene = createScene();
    const [scatter, clear] = [0.1 * SCATTERING, Math.exp(-0.1 * (SCATTERING + ABSORPTION))];
    const transmission_color = [clear, clear, clear] as const;
    addBox(
      scene,
      [-40, -40, -6],
      [40, 40, 0],
      milk(G, 0.1, { transmission_color, transmission_scatter: [scatter, scatter, scatter] }),
    );
    scene.lights.push(light);
    return scene;
  };
  const fresnel = (outer: number) => {
    const inner = Math.sqrt(1 - (1 - outer * outer) / (ETA * ETA));
    const s = ((outer - ETA * inner) / (outer + ETA * inner)) ** 2;
    const p = ((ETA * outer - inner) / (ETA * outer + inner)) ** 2;
    return (s + p) / 2;
  };
  /** Of light that comes at this cosine to the axis of view, inside. */
  const phase = (cosine: number) => (1 - G * G) / (4 * Math.PI * (1 + G * G + 2 * G * cosine) ** 1.5);

  /** One event: behind it light is absorbed alone, as `maxVolumeDepth` says. */
  async function expectRadiance(light: Light, expected: number): Promise<void> {
    const { mean, error } = await statistics(half(light), samplesOf(64, 4), {
      camera: narrow,
      maxDepth: 3,
      maxVolumeDepth: 1,
    });
    expect(error).toBeLessThan(0.01 * expected);
    expect(Math.abs(mean - expected), `${mean} ${expected} ± ${error}`).toBeLessThan(4 * error + 1e-4 * expected);
  }

  it('a directional one: single scattering in a half space', async () => {
    const outer = Math.cos(0.9);
    const inner = Math.sqrt(1 - (1 - outer * outer) / (ETA * ETA));
    const light: Light = {
      type: 'directional',
      name: 'sun',
      color: white,
      intensity: 5,
      direction: [Math.sin(0.9), 0, -outer],
    };
    // The beam is as much wider inside as the cosines say; leaving, radiance falls by η².
    const beam = (5 * (1 - fresnel(outer)) * outer) / inner;
    const depths = SCATTERING / (SCATTERING + ABSORPTION + ABSORPTION / inner);
    await expectRadiance(light, (beam * phase(inner) * depths * (1 - fresnel(1))) / (ETA * ETA));
  });

  it('a point: rays from it, traced through the surface', async () => {
    const [height, aside, intensity] = [0.4, 0.5, 5];
    const light: Light = { type: 'point', name: 'point', color: white, intensity, position: [aside, 0, height] };
    // Where a ray that leaves the light at an angle is at a depth.
    const ray = (angle: number, depth: number) => {
      const sine = Math.sin(angle) / ETA;
      const inner = Math.sqrt(1 - sine * sine);
      return { inner, across: height * Math.tan(angle) + (depth * sine) / inner };
    };
    let expected = 0;
    const STEPS = 4000;
    for (let i = 0; i < STEPS; i++) {
      const depth = ((i + 0.5) * 5) / STEPS;
      let [low, high] = [0, Math.PI / 2];
      for (let k = 0; k < 60; k++) {
        const middle = (low + high) / 2;
        if (ray(middle, depth).across < aside) low = middle;
        else high = middle;
      }
      const { inner, across } = ray(low, depth);
      const ring = (ray(low + 1e-6, depth).across - ray(low - 1e-6, depth).across) / 2e-6;
      // What leaves the light between two cones crosses a ring at that depth.
      const irradiance = (intensity * (1 - fresnel(Math.cos(low))) * Math.sin(low)) / (across * ring * inner);
      const passed = Math.exp(-(SCATTERING + ABSORPTION) * depth - (ABSORPTION * depth) / inner);
      expected += (irradiance * SCATTERING * phase(inner) * passed * 5) / STEPS;
    }
    await expectRadiance(light, (expected * (1 - fresnel(1))) / (ETA * ETA));
  });
});

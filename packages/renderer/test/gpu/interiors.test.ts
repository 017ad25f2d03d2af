import { testDevice } from '@glanz/gpu';
import type { Material, Scene } from '@glanz/scene';
import { beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { samplesOf } from '../full';
import { addBox, addQuad, addSphere, camera, createScene, lambert, meanOf, middle } from '../scenes';

type Vector = readonly [number, number, number];

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});

const SIZE = 16;

async function image(scene: Scene, samples: number, options: Partial<PathTracerOptions> = {}): Promise<Float32Array> {
  const tracer = await PathTracer.create(device, scene, { width: SIZE, height: SIZE, camera, ...options });
  try {
    for await (const progress of tracer.render({ samples })) void progress;
    return await tracer.read('beauty');
  } finally {
    tracer.destroy();
  }
}

/** Options for the pixels in the middle of the image alone. */
const inner = (size: number) => ({ width: size, height: size, camera: middle(size / SIZE) });

const surrounded = (radiance: Vector): Scene => ({ ...createScene(), environment: { type: 'constant', radiance } });

/** Matter of these coefficients (per metre), without an optical surface. */
const matter = (
  absorption: Vector,
  scattering: Vector = [0, 0, 0],
  anisotropy = 0,
  dielectric_priority = 0,
): Material => ({
  name: 'matter',
  dielectric_priority,
  parameters: {
    specular_ior: 1,
    transmission_weight: 1,
    transmission_depth: 0.1,
    transmission_color: absorption.map((a, k) => Math.exp(-0.1 * (a + (scattering[k] as number)))) as unknown as Vector,
    transmission_scatter: scattering.map((s) => 0.1 * s) as unknown as Vector,
    transmission_scatter_anisotropy: anisotropy,
  },
});

describe('interiors', () => {
  it('absorb along the way that light takes in them (Beer)', async () => {
    const scene = surrounded([1, 1, 1]);
    addBox(scene, [-2, -2, -0.5], [2, 2, 0.3], matter([0.5, 1, 3]));
    const seen = meanOf(await image(scene, 4), SIZE, 7, 7, 9, 9);
    [0.5, 1, 3].forEach((a, k) => expect(seen[k]).toBeCloseTo(Math.exp(-0.8 * a), 3));
  });

  it('that overlap: the higher priority is there', async () => {
    const both = (first: number, second: number) => {
      const scene = surrounded([1, 1, 1]);
      addBox(scene, [-2, -2, -0.5], [2, 2, 0.3], matter([1, 0, 2], [0, 0, 0], 0, first));
      addBox(scene, [-2, -2, 0.1], [2, 2, 1.2], matter([0, 1.5, 0.5], [0, 0, 0], 0, second));
      return scene;
    };
    // 0.6 m, 0.2 m of both, 0.9 m.
    const under = meanOf(await image(both(1, 2), 2), SIZE, 7, 7, 9, 9);
    [0.6 * 1, 1.1 * 1.5, 0.6 * 2 + 1.1 * 0.5].forEach((tau, k) => expect(under[k]).toBeCloseTo(Math.exp(-tau), 3));
    const over = meanOf(await image(both(2, 1), 2), SIZE, 7, 7, 9, 9);
    [0.8 * 1, 0.9 * 1.5, 0.8 * 2 + 0.9 * 0.5].forEach((tau, k) => expect(over[k]).toBeCloseTo(Math.exp(-tau), 3));
  });

  it('dim the light that a light sample finds through them', async () => {
    const scene = createScene();
    scene.lights.push({ type: 'directional', name: 'sun', color: [1, 1, 1], intensity: 2, direction: [0, 0, -1] });
    addQuad(scene, 2, -1, lambert(0.5));
    const open = meanOf(await image(scene, 2), SIZE, 0, 0, SIZE, SIZE);
    expect(open[0]).toBeCloseTo((0.5 * 2) / Math.PI, 4);
    // The camera is in front of the box: light crosses it once, and the view once more.
    addBox(scene, [-3, -3, -0.4], [3, 3, 0], matter([0.5, 1, 2]));
    const dimmed = meanOf(await image(scene, 4), SIZE, 7, 7, 9, 9);
    [0.5, 1, 2].forEach((a, k) => expect(dimmed[k]).toBeCloseTo(((0.5 * 2) / Math.PI) * Math.exp(-0.8 * a), 3));
  });

  it('that scatter without absorbing vanish in even light', async () => {
    for (const anisotropy of process.env['GLANZ_FULL'] === undefined ? [0.8, -0.5] : [0, 0.8, -0.5]) {
      const scene = surrounded([1, 0.5, 0.25]);
      addSphere(scene, 0.8, [0, 0, 0], matter([0, 0, 0], [1, 2, 5], anisotropy));
      const seen = meanOf(await image(scene, 128, { maxDepth: 256 }), SIZE, 0, 0, SIZE, SIZE);
      [1, 0.5, 0.25].forEach((l, k) => expect(seen[k]! / l).toBeCloseTo(1, 2));
    }
  });

  it('fog scatters once what single scattering says', async () => {
    const sigma = 0.5;
    const scene = createScene();
    scene.lights.push({ type: 'directional', name: 'sun', color: [1, 1, 1], intensity: 3, direction: [1, 0, 0] });
    addBox(scene, [-1.5, -1.5, -0.5], [1.5, 1.5, 0.5], matter([0, 0, 0], [sigma, sigma, sigma]));
    // σ · phase · irradiance of the beam from the side, along rays over the image: both ways dim it.
    let expected = 0;
    const [GRID, STEPS] = [8, 64];
    for (let i = 0; i < GRID * GRID; i++) {
      const [x, y] = [i % GRID, Math.floor(i / GRID)].map((k) => ((6 / SIZE) * ((2 * k + 1) / GRID - 1)) / 3);
      const stretch = Math.hypot(x!, y!, 1);
      for (let k = 0; k < STEPS; k++) {
        const depth = (k + 0.5) / STEPS;
        const way = depth * stretch + 1.5 + x! * (2.5 + depth);
        expected += (sigma * stretch * (3 / (4 * Math.PI)) * Math.exp(-sigma * way)) / (GRID * GRID * STEPS);
      }
    }
    // The standard error of sixteen images of other seeds, as below.
    const seen: number[] = [];
    for (let seed = 0; seed < 16; seed++)
      seen.push(meanOf(await image(scene, samplesOf(32, 2), { maxDepth: 2, seed, ...inner(6) }), 6, 0, 0, 6, 6)[0]);
    const mean = seen.reduce((sum, value) => sum + value, 0) / seen.length;
    const squares = seen.reduce((sum, value) => sum + (value - mean) ** 2, 0);
    const standardError = Math.sqrt(squares / (seen.length - 1) / seen.length);
    expect(Math.abs(mean - expected)).toBeLessThan(Math.min(4 * standardError, 0.01 * expected));
  });

  it('a solid ball of glass, smooth or rough, shows even light as it is', async () => {
    for (const specular_roughness of [0, 0.3]) {
      const scene = surrounded([1, 1, 1]);
      addSphere(
        scene,
        0.8,
        [0, 0, 0],
        { name: 'glass', parameters: { transmission_weight: 1, specular_ior: 1.5, specular_roughness } },
        96,
      );
      const seen = meanOf(await image(scene, 256, { maxDepth: 32, ...inner(8) }), 8, 0, 0, 8, 8);
      for (const value of seen) expect(Math.abs(value - 1)).toBeLessThan(0.01);
    }
  });

  it('a thin wall of glass with normals smoothed over its edges does not go black', async () => {
    const scene = surrounded([1, 1, 1]);
    const [low, high] = [
      [-0.7, -0.7, -0.02],
      [0.7, 0.7, 0.02],
    ] as const;
    addBox(scene, low, high, {
      name: 'glass',
      parameters: { transmission_weight: 1, specular_ior: 1.5, specular_roughness: 0 },
    });
    const [mesh] = scene.meshes;
    // Each corner's normal lies between its three faces', so that of the wide faces is as far off as 55°.
    mesh!.normals = mesh!.positions.map((value) => Math.sign(value) / Math.sqrt(3));
    const pixels = await image(scene, 256, { maxDepth: 64, ...inner(10) });
    const seen = meanOf(pixels, 10, 0, 0, 10, 10);
    for (const value of seen) expect(Math.abs(value - 1)).toBeLessThan(0.03);
    // No pixel of it is dark.
    for (let i = 0; i < 100; i++) expect(pixels[4 * i]).toBeGreaterThan(0.8);
  });

  it('milky glass that absorbs nothing returns what goes in', async () => {
    const scene = surrounded([1, 1, 1]);
    const { parameters } = matter([0, 0, 0], [4, 6, 9]);
    addSphere(scene, 0.8, [0, 0, 0], {
      name: 'milk',
      parameters: { ...parameters, specular_ior: 1.33, specular_roughness: 0.2 },
    });
    const seen = meanOf(await image(scene, 64, { maxDepth: 64, ...inner(8) }), 8, 0, 0, 8, 8);
    for (const value of seen) expect(Math.abs(value - 1)).toBeLessThan(0.02);
  });

  it('subsurface that absorbs nothing returns what goes in, and a coloured one its colour of a thick body', async () => {
    const body = (subsurface_color: Vector, parameters: Material['parameters'] = {}): Scene => {
      const scene = surrounded([1, 1, 1]);
      addSphere(scene, 0.8, [0, 0, 0], {
        name: 'wax',
        parameters: {
          subsurface_weight: 1,
          subsurface_color,
          subsurface_radius: 0.05,
          subsurface_radius_scale: [1, 0.6, 0.3],
          specular_roughness: 0.3,
          ...parameters,
        },
      });
      return scene;
    };
    // Pixels of independent numbers, each of which is 1 in the mean: their spread gives the standard error of the image's
    // mean. Beyond 3.3 of these lies one mean in 1000.
    const side = 24;
    const options = { maxDepth: 64, maxVolumeDepth: 1024, ...inner(6) };
    const white = await image(body([1, 1, 1]), samplesOf(16, 4), { ...options, width: side, height: side });
    for (const k of [0, 1, 2] as const) {
      const values = white.filter((_, i) => i % 4 === k);
      const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
      const squares = values.reduce((sum, value) => sum + (value - mean) ** 2, 0);
      const standardError = Math.sqrt(squares / (values.length - 1) / values.length);
      expect(Math.abs(mean - 1)).toBeLessThan(Math.min(3.3 * standardError, 0.02));
    }
    // Far smaller than the body, the walk sees a half space: what comes back is the colour, and what the surface
    // mirrors.
    const [r, g, b] = meanOf(
      await image(body([0.8, 0.5, 0.2], { subsurface_radius: 0.01 }), 64, { maxDepth: 64, ...inner(4) }),
      4,
      0,
      0,
      4,
      4,
    );
    const mirrored = 0.04;
    for (const [seen, color] of [
      [r, 0.8],
      [g, 0.5],
      [b, 0.2],
    ] as const)
      expect(Math.abs(seen - (mirrored + (1 - mirrored) * color))).toBeLessThan(0.05);
  });

  it('of more scattering events, or of more materials, than a path can count are refused', async () => {
    for (const maxVolumeDepth of [-1, 1.5, NaN, 65_536])
      await expect(image(surrounded([1, 1, 1]), 1, { maxVolumeDepth })).rejects.toMatchObject({
        code: 'renderer/option',
      });
    await expect(image(surrounded([1, 1, 1]), 1, { maxDepth: 65_536 })).rejects.toMatchObject({
      code: 'renderer/option',
    });
    const scene = surrounded([1, 1, 1]);
    for (let i = 0; i < 0x7fff; i++) scene.materials.push(lambert(0.5));
    addBox(scene, [-1, -1, -1], [1, 1, 1], matter([1, 1, 1]));
    await expect(image(scene, 1)).rejects.toMatchObject({ code: 'renderer/limit' });
  });

  it('a lamp in a block of absorbing glass lights a wall in it through the glass', async () => {
    const scene = createScene();
    const { parameters } = matter([1, 1, 1]);
    addQuad(scene, 0.5, -0.5, lambert(0.8));
    addBox(scene, [-1, -1, -1], [1, 1, 0.5], {
      name: 'glass',
      parameters: { ...parameters, specular_ior: 1.5, specular_roughness: 0 },
    });
    // A lamp of 1 cd, 0.3 m aside and 0.5 m in front, all inside; seen through 1 m of glass and its surface.
    scene.lights = [{ type: 'point', name: 'lamp', color: [1, 1, 1], intensity: 1, position: [0.3, 0, 0] }];
    const lit = meanOf(
      await image(scene, 32, { maxDepth: 3, camera: { ...camera, yfov: 0.02 } }),
      SIZE,
      0,
      0,
      SIZE,
      SIZE,
    );
    const reach = Math.hypot(0.3, 0.5);
    const expected = (0.8 / Math.PI) * (0.5 / reach ** 3) * Math.exp(-reach) * Math.exp(-1) * 0.96;
    expect(lit[0] / expected).toBeGreaterThan(0.99);
    expect(lit[0] / expected).toBeLessThan(1.01);
  });
});

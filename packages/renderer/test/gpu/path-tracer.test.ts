import { testDevice } from '@glanz/gpu';
import { beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type RenderError, type PathTracerOptions, type RenderOptions } from '../../src/index';
import type { Scene } from '@glanz/scene';
import { samplesOf } from '../full';
import { addQuad, addSphere, camera, createScene, lambert, meanOf } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});

async function render(
  scene: Scene,
  options: Partial<PathTracerOptions> & RenderOptions = {},
): Promise<{ pixels: Float32Array; tracer: PathTracer }> {
  const tracer = await PathTracer.create(device, scene, {
    width: 16,
    height: 16,
    camera,
    pathsInFlight: 1 << 14,
    ...options,
  });
  for await (const _ of tracer.render({ maxSubmitMs: 1000, samples: 16, ...options }));
  return { pixels: await tracer.read('beauty'), tracer };
}

// Bit for bit, without a listing of thousands of numbers where it fails.
const same = (a: Float32Array, b: Float32Array) =>
  a.length === b.length && a.every((value, i) => Object.is(value, b[i]));

describe('light transport against analytic values', () => {
  it('a Lambert plane under constant light reflects albedo × radiance, without noise', async () => {
    const scene = createScene();
    addQuad(scene, 10, 0, lambert(0.25, 0.5, 0.75));
    scene.environment = { type: 'constant', radiance: [1, 2, 4] };
    const { pixels, tracer } = await render(scene, { samples: 4 });
    for (let i = 0; i < 256; i++) {
      expect(pixels[4 * i]).toBeCloseTo(0.25, 5);
      expect(pixels[4 * i + 1]).toBeCloseTo(1, 5);
      expect(pixels[4 * i + 2]).toBeCloseTo(3, 5);
      expect(pixels[4 * i + 3]).toBe(1);
    }
    expect(tracer.statistics.badSamples).toBe(0);
    tracer.destroy();
  });

  it('counts its rays: one a sample into the void, with a light one more from each surface that sees it', async () => {
    const scene = createScene();
    addQuad(scene, 10, 0, lambert(0.5));
    const paths = 16 * 16 * 4;
    const { tracer } = await render(scene, { samples: 4, maxDepth: 1 });
    expect(await tracer.readRayCount()).toBe(paths);
    tracer.reset();
    for await (const _ of tracer.render({ samples: 4 }));
    expect(await tracer.readRayCount()).toBe(2 * paths);
    tracer.destroy();
    scene.lights.push({ type: 'directional', name: 'd', color: [1, 1, 1], intensity: 3, direction: [0, 0, -1] });
    const lit = await render(scene, { samples: 4, maxDepth: 2 });
    // From the camera, to the light, and on to what else there might be.
    expect(await lit.tracer.readRayCount()).toBe(3 * paths);
    lit.tracer.destroy();
  });

  it('a point light gives ρ/π · I · cos θ / d²', async () => {
    const scene = createScene();
    addQuad(scene, 10, 0, lambert(0.5));
    scene.lights.push({ type: 'point', name: 'p', color: [1, 1, 1], intensity: 8, position: [0, 0, 2] });
    const { pixels, tracer } = await render(scene, { width: 15, height: 15, samples: 256 });
    const [centre] = meanOf(pixels, 15, 7, 7, 8, 8);
    // The pixel in the middle covers ±1/15 m.
    expect(centre).toBeCloseTo((0.5 / Math.PI) * (8 / 4), 2);
    tracer.destroy();
  });

  it('a directional light gives ρ/π · E · cos θ', async () => {
    const scene = createScene();
    addQuad(scene, 10, 0, lambert(0.5));
    const angle = 1;
    scene.lights.push({
      type: 'directional',
      name: 'd',
      color: [1, 0.5, 0.25],
      intensity: 3,
      direction: [Math.sin(angle), 0, -Math.cos(angle)],
    });
    const { pixels, tracer } = await render(scene, { samples: 2 });
    const [r, g, b] = meanOf(pixels, 16, 0, 0, 16, 16);
    const expected = (0.5 / Math.PI) * 3 * Math.cos(angle);
    expect(r).toBeCloseTo(expected, 5);
    expect(g).toBeCloseTo(expected / 2, 5);
    expect(b).toBeCloseTo(expected / 4, 5);
    tracer.destroy();
  });

  it.each([
    ['next-event estimation and BSDF samples together', 1],
    ['a light close enough for BSDF samples to matter', 4],
  ])('a square emitter facing a plane gives the form factor of parallel squares: %s', async (_, size) => {
    const scene = createScene();
    addQuad(scene, 50, 0, lambert(0.8));
    // Faces −z, towards the plane.
    addQuad(
      scene,
      size / 2,
      1,
      { name: 'light', parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 5 } },
      { flip: true },
    );
    // From (1.5, 0, 0.5), under the light, down to the origin.
    const tilt = Math.atan2(0.5, 1.5);
    const side = {
      ...camera,
      transform: [
        0,
        1,
        0,
        0,
        -Math.sin(tilt),
        0,
        Math.cos(tilt),
        0,
        Math.cos(tilt),
        0,
        Math.sin(tilt),
        0,
        1.5,
        0,
        0.5,
        1,
      ],
      yfov: 0.01,
    };
    const { pixels, tracer } = await render(scene, { camera: side, samples: 2048, maxDepth: 2, width: 8, height: 8 });
    const [value] = meanOf(pixels, 8, 3, 3, 5, 5);
    // From a point below the middle of a rectangle a × b at distance 1, per quarter (Howell, configuration B-3).
    const h = size / 2;
    const quarter = (1 / (2 * Math.PI)) * 2 * ((h / Math.sqrt(1 + h * h)) * Math.atan(h / Math.sqrt(1 + h * h)));
    const expected = 0.8 * 5 * 4 * quarter;
    expect(Math.abs(value - expected) / expected).toBeLessThan(0.02);
    tracer.destroy();
  });

  it('a closed furnace is 1 everywhere: emission and albedo of one half each', async () => {
    const scene = createScene();
    addSphere(scene, 5, [0, 0, 0], {
      name: 'furnace',
      parameters: { base_color: [0.5, 0.5, 0.5], specular_weight: 0, emission_luminance: 0.5 },
      double_sided: true,
    });
    const { pixels, tracer } = await render(scene, { samples: samplesOf(128, 2), maxDepth: 24 });
    const [r, g, b] = meanOf(pixels, 16, 0, 0, 16, 16);
    for (const value of [r, g, b]) expect(Math.abs(value - 1)).toBeLessThan(0.01);
    tracer.destroy();
  });

  it('opacity α shows α of the surface and 1 − α of what lies behind', async () => {
    const scene = createScene();
    addQuad(scene, 10, 0, {
      name: 'veil',
      parameters: { base_color: [0, 0, 0], specular_weight: 0, geometry_opacity: 0.4 },
    });
    scene.environment = { type: 'constant', radiance: [1, 1, 1] };
    const { pixels, tracer } = await render(scene, { samples: 256 });
    const [value] = meanOf(pixels, 16, 0, 0, 16, 16);
    expect(Math.abs(value - 0.6)).toBeLessThan(0.006);
    tracer.destroy();
  });

  it('an emitter shines from its front only, unless it is double-sided', async () => {
    const emitter = { name: 'e', parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 2 } };
    for (const [double_sided, expected] of [
      [false, 0],
      [true, 2],
    ] as const) {
      const scene = createScene();
      addQuad(scene, 10, 0, { ...emitter, double_sided }, { flip: true });
      const { pixels, tracer } = await render(scene, { samples: 2 });
      expect(pixels[0]).toBe(expected);
      tracer.destroy();
    }
  });
});

describe('environment and textures', () => {
  const skyWith = (x: number, y: number) => {
    const data = new Float32Array(64 * 32 * 3);
    data.set([9, 5, 1], 3 * (y * 64 + x));
    return { type: 'latlong', width: 64, height: 32, data } as const;
  };

  it('the image’s centre lies towards +X, u grows towards +Z, rotation turns it about +Y', async () => {
    // Looking along −z: u = atan2(−1, 0)/2π + ½ = ¼, v = ½.
    for (const [texel, rotation] of [
      [16, 0],
      [32, Math.PI / 2],
    ] as const) {
      const scene = createScene();
      addQuad(scene, 0.001, 100, lambert(0));
      scene.environment = { ...skyWith(texel, 16), rotation };
      const { pixels, tracer } = await render(scene, {
        samples: 16,
        width: 32,
        height: 32,
        camera: { ...camera, yfov: 1 },
      });
      let best = 0;
      for (let i = 0; i < 1024; i++) if ((pixels[4 * i] as number) > (pixels[4 * best] as number)) best = i;
      // The texel's centre lies half a texel beyond the view axis, to the right (+x) or towards it, and below.
      expect(Math.abs((best % 32) - 16)).toBeLessThanOrEqual(3);
      expect(Math.abs(Math.floor(best / 32) - 17)).toBeLessThanOrEqual(3);
      expect(pixels[4 * best]).toBeGreaterThan(1);
      tracer.destroy();
    }
  });

  it('a plane under a small bright patch of sky gets the patch’s irradiance', async () => {
    const scene = createScene();
    addQuad(scene, 10, 0, lambert(1));
    // Straight towards +z: u = atan2(1, 0)/2π + ½ = ¾.
    scene.environment = skyWith(48, 16);
    const { pixels, tracer } = await render(scene, { samples: 512 });
    const value = meanOf(pixels, 16, 0, 0, 16, 16);
    // ∫ L cos θ dω of the bilinear bump by quadrature.
    let irradiance = 0;
    const n = 400;
    for (let i = 0; i < n; i++) {
      for (let j = 0; j < n; j++) {
        const fu = ((i + 0.5) / n) * 2 - 1;
        const fv = ((j + 0.5) / n) * 2 - 1;
        const u = (48.5 + fu) / 64;
        const v = (16.5 + fv) / 32;
        const theta = v * Math.PI;
        const phi = (u - 0.5) * 2 * Math.PI;
        const cosine = Math.sin(theta) * Math.sin(phi);
        irradiance +=
          (1 - Math.abs(fu)) *
          (1 - Math.abs(fv)) *
          Math.max(cosine, 0) *
          Math.sin(theta) *
          ((2 / n) * ((2 * Math.PI) / 64)) *
          ((2 / n) * (Math.PI / 32));
      }
    }
    expect(Math.abs(value[0] - (9 * irradiance) / Math.PI) / value[0]).toBeLessThan(0.01);
    expect(value[1] / value[0]).toBeCloseTo(5 / 9, 4);
    tracer.destroy();
  });

  it('a texture lies upright, is decoded from sRGB, and its upper left texel is at uv (0, 0)', async () => {
    const scene = createScene();
    const index = addQuad(scene, 1, 0, lambert(1));
    const texels = [
      [255, 0, 0, 255],
      [0, 255, 0, 255],
      [0, 0, 255, 255],
      [188, 188, 188, 255],
    ].flat();
    scene.images.push({ name: 'four', width: 2, height: 2, data: new Uint8Array(texels) });
    scene.textures.push({ image: 0, color_space: 'srgb', wrap_u: 'clamp', wrap_v: 'clamp', filter: 'nearest' });
    (scene.materials[index] as Scene['materials'][number]).textures = { base_color: { texture: 0, channels: 'rgb' } };
    scene.environment = { type: 'constant', radiance: [1, 1, 1] };
    const { pixels, tracer } = await render(scene, { samples: 4 });
    const at = (x: number, y: number) =>
      [...pixels.subarray(4 * (y * 16 + x), 4 * (y * 16 + x) + 3)].map((v) => Number(v.toFixed(3)));
    expect(at(3, 3)).toEqual([1, 0, 0]);
    expect(at(12, 3)).toEqual([0, 1, 0]);
    expect(at(3, 12)).toEqual([0, 0, 1]);
    const grey = ((188 / 255 + 0.055) / 1.055) ** 2.4;
    for (const v of at(12, 12)) expect(v).toBeCloseTo(grey, 2);
    tracer.destroy();
  });

  it('a normal map bends the light the way it says: red right, green up', async () => {
    const lit = async (texel: readonly [number, number, number], direction: readonly [number, number, number]) => {
      const scene = createScene();
      const index = addQuad(scene, 1, 0, lambert(1));
      scene.images.push({ name: 'n', width: 1, height: 1, data: new Uint8Array([...texel, 255]) });
      scene.textures.push({ image: 0, color_space: 'linear' });
      (scene.materials[index] as Scene['materials'][number]).textures = {
        geometry_normal: { texture: 0, channels: 'rgb' },
      };
      scene.lights.push({ type: 'directional', name: 'd', color: [1, 1, 1], intensity: Math.PI, direction });
      const { pixels, tracer } = await render(scene, { samples: 1 });
      tracer.destroy();
      return pixels[4 * (8 * 16 + 8)] as number;
    };
    const s = Math.SQRT1_2;
    // Light from the right (+x) or from above (+y), 45° to the plane; normals bent 45° towards it or away from it.
    expect(await lit([218, 128, 218], [-s, 0, -s])).toBeGreaterThan(0.97);
    expect(await lit([37, 128, 218], [-s, 0, -s])).toBeLessThan(0.05);
    expect(await lit([128, 218, 218], [0, -s, -s])).toBeGreaterThan(0.97);
    expect(await lit([128, 37, 218], [0, -s, -s])).toBeLessThan(0.05);
  });
});

describe('the session', () => {
  const cornell = () => {
    const scene = createScene();
    addQuad(scene, 2, 0, { name: 'red', parameters: { base_color: [0.8, 0.2, 0.2], specular_roughness: 0.2 } });
    addSphere(
      scene,
      0.4,
      [0, 0, 0.5],
      { name: 'gold', parameters: { base_metalness: 1, base_color: [1, 0.8, 0.3] } },
      24,
    );
    addQuad(
      scene,
      0.5,
      2,
      { name: 'light', parameters: { emission_luminance: 4 } },
      { flip: true, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1.2, 1.2, 0, 1] },
    );
    scene.environment = { type: 'constant', radiance: [0.2, 0.3, 0.4] };
    return scene;
  };

  it('gives the same image bit for bit whatever the batches, also when interrupted', async () => {
    const settings = { width: 8, height: 8, samples: 70, seed: 5 };
    const reference = (await render(cornell(), settings)).pixels;
    const small = (await render(cornell(), { ...settings, pathsInFlight: 25, maxSubmitMs: 1 })).pixels;
    expect(same(small, reference)).toBe(true);
    const { tracer } = await render(cornell(), { ...settings, samples: 3, pathsInFlight: 75 });
    const controller = new AbortController();
    for await (const { samples } of tracer.render({ samples: 70, signal: controller.signal }))
      if (samples > 20) controller.abort();
    expect(tracer.samples).toBeLessThan(70);
    for await (const _ of tracer.render({ samples: 70 }));
    expect(same(await tracer.read('beauty'), reference)).toBe(true);
    const other = (await render(cornell(), { ...settings, seed: 6 })).pixels;
    expect(same(other, reference)).toBe(false);
  });

  it('gives depth, normal, albedo and ids of what the camera sees', async () => {
    const scene = createScene();
    addQuad(scene, 0.5, 0, lambert(0.25, 0.5, 0.75));
    scene.environment = { type: 'constant', radiance: [1, 1, 1] };
    const { tracer } = await render(scene, { samples: 16, background: 'transparent' });
    const centre = 8 * 16 + 8;
    const [depth, normal, albedo, objects, materials, beauty] = await Promise.all([
      tracer.read('depth'),
      tracer.read('normal'),
      tracer.read('albedo'),
      tracer.read('objectId'),
      tracer.read('materialId'),
      tracer.read('beauty'),
    ]);
    // The pixel reaches from the axis to an eighth of a metre beside it: rays through it are 3 √(1 + r² / 9) long, 1.74 mm
    // more on average, with a standard error of 0.3 mm for 16 samples.
    expect(Math.abs((depth[centre] as number) - 3.00174)).toBeLessThan(0.001);
    expect([...normal.subarray(4 * centre, 4 * centre + 3)]).toEqual([0, 0, 1]);
    for (const [k, v] of [0.25, 0.5, 0.75].entries()) expect(albedo[4 * centre + k]).toBeCloseTo(v, 3);
    expect([objects[centre], materials[centre], objects[0], materials[0]]).toEqual([0, 0, 0xffffffff, 0xffffffff]);
    expect(depth[0]).toBe(0);
    expect([...beauty.subarray(0, 4)]).toEqual([0, 0, 0, 0]);
    expect(beauty[4 * centre + 3]).toBe(1);
    tracer.destroy();
  });

  it('finds the part under a pixel', async () => {
    const { tracer } = await render(cornell(), { samples: 1 });
    const hit = tracer.pick(8, 8);
    expect(hit).toMatchObject({ instance: 1, material: 1 });
    expect(hit?.distance).toBeCloseTo(3 - 0.9, 5);
    expect(tracer.pick(-500, 8)).toBeUndefined();
    tracer.destroy();
  });

  it('shows an edited material, environment, camera and size', async () => {
    const scene = createScene();
    addQuad(scene, 10, 0, lambert(0.5));
    scene.environment = { type: 'constant', radiance: [1, 1, 1] };
    const { tracer } = await render(scene, { samples: 2 });
    const value = async () => {
      for await (const _ of tracer.render({ samples: 2, maxSubmitMs: 1000 }));
      return (await tracer.read('beauty'))[0];
    };
    await tracer.setMaterial('lambert', { base_color: [0.25, 0.25, 0.25] });
    expect(await value()).toBeCloseTo(0.25, 5);
    expect(scene.materials[0]?.parameters.base_color).toEqual([0.5, 0.5, 0.5]);
    await tracer.setEnvironment({ type: 'constant', radiance: [2, 2, 2] });
    expect(await value()).toBeCloseTo(0.5, 5);
    await tracer.setMaterial(0, { emission_luminance: 3 });
    expect(await value()).toBeCloseTo(3.5, 4);
    await tracer.resize(5, 7);
    expect(await value()).toBeCloseTo(3.5, 4);
    expect((await tracer.read('beauty')).length).toBe(5 * 7 * 4);
    await tracer.setCamera({ ...camera, transform: [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 3, 1] });
    expect(await value()).toBeCloseTo(2, 5);
    tracer.destroy();
  });

  it('refuses what cannot be done with typed errors', async () => {
    const scene = cornell();
    const code = async (run: () => unknown) => {
      try {
        await run();
      } catch (error) {
        return (error as RenderError).code;
      }
      return undefined;
    };
    expect(await code(() => PathTracer.create(device, scene, { width: 0, height: 0 }))).toBe('renderer/size');
    expect(await code(() => PathTracer.create(device, createScene(), { width: 4, height: 4 }))).toBe(
      'renderer/no-triangles',
    );
    expect(await code(() => PathTracer.create(device, scene, { width: 4, height: 4, camera: 'nowhere' }))).toBe(
      'renderer/camera',
    );
    const { tracer } = await render(scene, { samples: 1 });
    expect(await code(() => tracer.setMaterial('nothing', {}))).toBe('renderer/material');
    expect(await code(() => tracer.render({ samples: 0 }).next())).toBe('renderer/samples');
    const running = tracer.render({ samples: 4 });
    await running.next();
    expect(await code(() => tracer.render({ samples: 4 }).next())).toBe('renderer/busy');
    await running.return();
    tracer.destroy();
    tracer.destroy();
    expect(await code(() => tracer.read('beauty'))).toBe('renderer/destroyed');
  });

  it('stops preparing when aborted', async () => {
    const controller = new AbortController();
    controller.abort();
    await expect(
      PathTracer.create(device, cornell(), { width: 4, height: 4, signal: controller.signal }),
    ).rejects.toThrow(/abort/i);
  });
});

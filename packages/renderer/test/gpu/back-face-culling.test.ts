import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Camera, Material, Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { readBuffer } from '../../src/storage/read-buffer';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { addBox, addQuad, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

const SIZE = 8;
const GREY = 0.5;

async function withTracer<T>(
  scene: Scene,
  options: Partial<PathTracerOptions>,
  use: (tracer: PathTracer) => Promise<T>,
  samples = 16,
): Promise<T> {
  const tracer = await PathTracer.create(device, scene, {
    width: SIZE,
    height: SIZE,
    camera,
    backFaceCulling: 'camera',
    pathsInFlight: 1 << 12,
    ...options,
  });
  try {
    for await (const _ of tracer.render({ samples, maxSubmitMs: 2000 }));
    return await use(tracer);
  } finally {
    tracer.destroy();
  }
}

const beauty = (scene: Scene, options: Partial<PathTracerOptions> = {}, samples?: number) =>
  withTracer(scene, options, (tracer) => tracer.read('beauty'), samples);

/** Mean of the red of all pixels. */
const red = (pixels: Float32Array) =>
  pixels.reduce((sum, value, i) => (i % 4 === 0 ? sum + value : sum), 0) / (SIZE * SIZE);

/** A wall of a material, wider than the view, in even white light. */
function wallOf(material: Material, options: Parameters<typeof addQuad>[4] = {}): Scene {
  const scene = createScene();
  addQuad(scene, 50, 0, material, options);
  scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  return scene;
}

const glow = (radiance: number): Material => ({
  name: 'glow',
  parameters: { base_weight: 0, specular_weight: 0, emission_luminance: radiance },
});
const MIRROR_X = [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** A closed room of walls that face inwards; the camera stands outside. */
function room(wall: Material): Scene {
  const scene = createScene();
  addBox(scene, [-2, -2, -2], [2, 2, 2], wall);
  const { indices } = scene.meshes[0]!;
  for (let i = 0; i < indices.length; i += 3) [indices[i + 1], indices[i + 2]] = [indices[i + 2]!, indices[i + 1]!];
  return scene;
}

describe('what the camera sees', () => {
  it('is the inside of a closed room whose walls face inwards, as if the wall before it were open', async () => {
    // In a closed room of even walls that emit E and reflect r, each point shines as E / (1 - r).
    const emits = 0.25,
      reflects = 0.5;
    const wall: Material = {
      name: 'wall',
      parameters: { base_color: [reflects, reflects, reflects], specular_weight: 0, emission_luminance: emits },
    };
    const inside = await beauty(room(wall), { maxDepth: 24 }, 64);
    // The wall's back emits nothing, and by default that is what is seen.
    const outside = await beauty(room(wall), { maxDepth: 24, backFaceCulling: 'off' }, 4);
    expect(Math.max(...outside.filter((_, i) => i % 4 === 0))).toBe(0);
    for (let i = 0; i < SIZE * SIZE; i++) expect(inside[4 * i + 3]).toBe(1);
    // 64 pixels of 64 samples of light that is estimated with a relative deviation of less than 1 each: 1/64.
    expect(Math.abs(red(inside) / (emits / (1 - reflects)) - 1)).toBeLessThan(4 / 64);
  });

  it.each([
    ['a front', {}, 'wall'],
    ['a back', { flip: true }, 'beyond'],
    ['a back that a mirroring place turns to the front', { flip: true, transform: MIRROR_X }, 'beyond'],
    ['a front in a mirroring place', { transform: MIRROR_X }, 'wall'],
  ] as const)('%s', async (_, options, seen) => {
    const scene = wallOf(glow(3), options);
    // Emission leaves from the front alone; what is beyond is white.
    const expected = seen === 'wall' ? 3 : 1;
    expect(red(await beauty(scene))).toBeCloseTo(expected, 5);
    // By default the back is there, and dark.
    expect(red(await beauty(scene, { backFaceCulling: 'off' }))).toBeCloseTo(seen === 'wall' ? 3 : 0, 5);
  });

  it.each([
    ['double-sided', { ...lambert(0), double_sided: true }],
    [
      'glass',
      {
        name: 'glass',
        parameters: { transmission_weight: 1, transmission_color: [0.5, 0.5, 0.5], geometry_thin_walled: true },
      },
    ],
    ['wax', { name: 'wax', parameters: { subsurface_weight: 1, geometry_thin_walled: true } }],
    ['half there', { name: 'veil', parameters: { base_color: [0, 0, 0], specular_weight: 0, geometry_opacity: 0.5 } }],
  ] as readonly (readonly [string, Material])[])('does not change for a material that is %s', async (_, material) => {
    const scene = wallOf(material, { flip: true });
    expect(await beauty(scene)).toEqual(await beauty(scene, { backFaceCulling: 'off' }));
  });

  it('is the inside of a glass ball as before, whatever else is culled', async () => {
    const scene = createScene();
    addBox(scene, [-0.5, -0.5, -0.5], [0.5, 0.5, 0.5], {
      name: 'glass',
      parameters: { transmission_weight: 1, transmission_depth: 0.5, transmission_color: [0.2, 0.6, 0.9] },
    });
    addBox(scene, [-2, -2, -4], [2, 2, -3], lambert(0.6));
    scene.environment = { type: 'constant', radiance: [1, 1, 1] };
    // A box that faces outwards shows no back to a camera outside.
    expect(await beauty(scene)).toEqual(await beauty(scene, { backFaceCulling: 'off' }));
  });

  it('is a cut-out where it is there on its front, and nothing of it on its back', async () => {
    const leaf = (flip: boolean) =>
      wallOf(
        { ...lambert(0), parameters: { ...lambert(0).parameters, geometry_opacity: 0.7 }, opacity_threshold: 0.5 },
        { flip },
      );
    expect(red(await beauty(leaf(false)))).toBeCloseTo(0, 6);
    expect(red(await beauty(leaf(true)))).toBeCloseTo(1, 6);
  });

  it('goes on behind a window of smooth thin glass', async () => {
    const scene = createScene();
    const clear: Material = {
      name: 'window',
      parameters: { transmission_weight: 1, specular_weight: 0, specular_roughness: 0, geometry_thin_walled: true },
    };
    addQuad(scene, 50, 1, clear);
    addQuad(scene, 50, 0, lambert(0), { flip: true });
    addQuad(scene, 50, -1, glow(2));
    expect(red(await beauty(scene))).toBeCloseTo(2, 4);
  });

  it('is what the layers and a click find', async () => {
    const scene = createScene();
    addQuad(scene, 50, 0, lambert(0.1), { flip: true, transform: [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] });
    addQuad(scene, 50, -1, lambert(0.9));
    // In the place of the back, to the digit.
    addQuad(scene, 0.2, 0, lambert(0.5));
    scene.environment = { type: 'constant', radiance: [1, 1, 1] };
    await withTracer(scene, {}, async (tracer) => {
      const [albedo, position, objectId] = [
        await tracer.read('albedo'),
        await tracer.read('position'),
        await tracer.read('objectId'),
      ];
      expect(objectId[0]).toBe(1);
      expect(objectId[(SIZE / 2) * (SIZE + 1)]).toBe(2);
      expect(albedo[0]).toBeCloseTo(0.9, 2);
      expect(position[2]).toBeCloseTo(-1, 5);
      expect(tracer.pick(0.5, 0.5)).toMatchObject({ instance: 1 });
      expect(tracer.pick(0.5, 0.5)!.position[2]).toBeCloseTo(-1, 9);
      expect(tracer.pick(SIZE / 2, SIZE / 2)).toMatchObject({ instance: 2 });
    });
    await withTracer(scene, { backFaceCulling: 'off' }, async (tracer) =>
      expect(tracer.pick(0.5, 0.5)).toMatchObject({ instance: 0 }),
    );
  });

  it('is what the first image shows too, while kernels compile', async () => {
    const scene = wallOf(lambert(0), { flip: true });
    // Out of sight, and much to compile.
    addQuad(scene, 1, 10, {
      name: 'rich',
      parameters: { coat_weight: 0.5, fuzz_weight: 0.5, thin_film_weight: 0.5, transmission_weight: 0.5 },
    });
    let shown: Promise<Float32Array> | undefined;
    const tracer = await PathTracer.create(device, scene, {
      width: 4,
      height: 4,
      camera,
      backFaceCulling: 'camera',
      onFirstLight: ({ buffer }) =>
        void (shown = readBuffer(device, buffer, 256).then((bytes) => new Float32Array(bytes))),
    });
    tracer.destroy();
    expect([...(await shown!)]).toEqual(Array(64).fill(1));
  });

  it('is the front wall again once the material lets light through', async () => {
    const scene = wallOf(lambert(0), { flip: true });
    await withTracer(scene, {}, async (tracer) => {
      expect(red(await tracer.read('beauty'))).toBeCloseTo(1, 5);
      await tracer.setMaterial(0, {
        transmission_weight: 1,
        geometry_thin_walled: true,
        transmission_color: [0, 0, 0],
      });
      for await (const _ of tracer.render({ samples: 16 }));
      expect(red(await tracer.read('beauty'))).toBeLessThan(0.2);
    });
  });
});

// Looks at a floor of y = 0 from above, over whatever lies above it.
const above: Camera = {
  type: 'orthographic',
  name: 'above',
  xmag: 0.5,
  ymag: 0.5,
  transform: [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 5, 0, 1],
};
const LYING = [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1];
const lying = (height: number) => [...LYING.slice(0, 13), height, 0, 1];

describe('with "camera" light finds the back faces', () => {
  it('a ceiling that the camera looks through keeps the sun off the floor', async () => {
    const scene = createScene();
    addQuad(scene, 50, 0, lambert(GREY), { transform: LYING });
    scene.lights.push({
      type: 'directional',
      name: 'sun',
      color: [1, 1, 1],
      intensity: Math.PI,
      direction: [0, -1, 0],
    });
    const open = red(await beauty(scene, { camera: above, maxDepth: 2 }));
    expect(open).toBeCloseTo(GREY, 4);
    // Faces down: its back is to the camera and to the sun.
    addQuad(scene, 50, 0, lambert(1), { flip: true, transform: lying(2) });
    expect(red(await beauty(scene, { camera: above, maxDepth: 2 }))).toBe(0);
  });

  it('and returns what the floor sends up: between two parallel planes it bounces on', async () => {
    const emits = 0.2,
      reflects = 0.6;
    const scene = createScene();
    const wall: Material = {
      name: 'wall',
      parameters: { base_color: [reflects, reflects, reflects], specular_weight: 0, emission_luminance: emits },
    };
    // Each sees nothing but the other, so both shine as E / (1 - r).
    addQuad(scene, 500, 0, wall, { transform: LYING });
    addQuad(scene, 500, 0, { ...wall }, { flip: true, transform: lying(1) });
    const seen = red(await beauty(scene, { camera: above, maxDepth: 24 }, 64));
    expect(Math.abs(seen / (emits / (1 - reflects)) - 1)).toBeLessThan(4 / 64);
  });

  it('a mirror shows them', async () => {
    const scene = createScene();
    scene.environment = { type: 'constant', radiance: [1, 1, 1] };
    const mirror: Material = {
      name: 'mirror',
      parameters: { base_metalness: 1, base_color: [1, 1, 1], specular_color: [1, 1, 1], specular_roughness: 0 },
    };
    addQuad(scene, 50, 0, mirror);
    expect(red(await beauty(scene))).toBeCloseTo(1, 2);
    // Behind the camera, with its back to the mirror.
    addQuad(scene, 500, 4, lambert(0));
    expect(red(await beauty(scene))).toBe(0);
  });
});

describe('with "all" the model is cut open', () => {
  const open: Partial<PathTracerOptions> = { camera: above, backFaceCulling: 'all' };
  const even: Scene['environment'] = { type: 'latlong', width: 8, height: 4, data: new Float32Array(96).fill(1) };
  // A floor, and a ceiling that faces it: its back is to the camera.
  const storey = (ceiling: Material): Scene => {
    const scene = createScene();
    addQuad(scene, 500, 0, lambert(GREY), { transform: LYING });
    addQuad(scene, 500, 0, ceiling, { flip: true, transform: lying(2) });
    return scene;
  };

  it('the sun falls on the floor through the ceiling that is cut away', async () => {
    const scene = storey(lambert(1));
    scene.lights.push({
      type: 'directional',
      name: 'sun',
      color: [1, 1, 1],
      intensity: Math.PI,
      direction: [0, -1, 0],
    });
    expect(red(await beauty(scene, open))).toBeCloseTo(GREY, 4);
    // In perspective it is the camera's place that decides: from below the ceiling is seen, so it is there.
    expect(red(await beauty(scene, { ...open, camera: { ...camera, transform: lying(5) } }))).toBeCloseTo(GREY, 4);
    expect(red(await beauty(scene, { ...open, camera: { ...camera, transform: lying(1) } }))).toBe(0);
  });

  it('and so does the light of the environment, by whatever way it is found', async () => {
    const scene = storey(lambert(1));
    scene.environment = even;
    const sampled = await beauty(scene, open, 64);
    // Each sample is GREY times a weight of mean 1 that is below 2: a deviation below GREY over the root of 4096
    // samples.
    expect(Math.abs(red(sampled) - GREY)).toBeLessThan((4 * GREY) / 64);
    scene.environment = { type: 'constant', radiance: [1, 1, 1] };
    expect(red(await beauty(scene, open))).toBeCloseTo(GREY, 4);
  });

  it('but lamps shine on, and the camera looks through their backs', async () => {
    const scene = storey(glow(3));
    // A floor under an endless even ceiling of radiance 3 that reflects nothing.
    expect(Math.abs(red(await beauty(scene, open, 64)) / (3 * GREY) - 1)).toBeLessThan(4 / 64);
  });

  it('glass and cut-outs are as they were', async () => {
    const scene = storey({
      name: 'glass',
      parameters: { transmission_weight: 1, specular_roughness: 0, geometry_thin_walled: true },
    });
    scene.environment = { type: 'constant', radiance: [1, 1, 1] };
    expect(await beauty(scene, open)).toEqual(await beauty(scene, { ...open, backFaceCulling: 'off' }));
    const leaves = storey({
      ...lambert(0),
      opacity_threshold: 0.5,
      parameters: { ...lambert(0).parameters, geometry_opacity: 0.7 },
    });
    leaves.environment = scene.environment;
    expect(red(await beauty(leaves, open))).toBeCloseTo(GREY, 4);
  });
});

it('a scene with nothing to cull has the kernels of a tracer that does not cull', async () => {
  const texts: string[] = [];
  const watched = new Proxy(device, {
    get: (target, name) => {
      const value = Reflect.get(target, name) as unknown;
      if (name === 'createShaderModule') {
        return (descriptor: GPUShaderModuleDescriptor) => {
          texts.push(descriptor.code);
          return target.createShaderModule(descriptor);
        };
      }
      return typeof value === 'function' ? (value as () => unknown).bind(target) : value;
    },
  });
  const textsOf = async (material: Material, backFaceCulling: 'off' | 'camera') => {
    texts.length = 0;
    const tracer = await PathTracer.create(watched, wallOf(material), { width: 4, height: 4, camera, backFaceCulling });
    tracer.destroy();
    return texts.join('\n');
  };
  expect(await textsOf({ ...lambert(0.5), double_sided: true }, 'camera')).not.toContain('culling');
  expect(await textsOf(lambert(0.5), 'off')).not.toContain('culling');
  expect(await textsOf(lambert(0.5), 'camera')).toContain('culling_accept');
});

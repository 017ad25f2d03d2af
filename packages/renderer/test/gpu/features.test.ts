import { OPENPBR_TABLES } from '@glanz/openpbr/tables';
import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Environment, Scene } from '@glanz/scene';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { GpuMemory } from '../../src/storage/buffers';
import { energyTextures } from '../../src/materials/energy-textures';
import { GpuScene } from '../../src/scene/gpu-scene';
import { PathTracer } from '../../src/index';
import { prepareEnvironment } from '../../src/environment/environment';
import { expectedFeatures, type SceneChoices } from '../../src/scene/features';
import { prepareGeometry } from '../../src/geometry/prepare-geometry';
import { addQuad, addSphere, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

const CHOICES: SceneChoices = {
  guiding: 0,
  multipleScattering: true,
  sampler: 'blue-noise',
  lightGroups: 'named',
  lightSampling: 'tree',
  shadowTerminator: 'smooth',
  backFaceCulling: 'all',
};

const plain = (): Scene => {
  const scene = createScene();
  addQuad(scene, 1, 0, lambert(0.5));
  return scene;
};

const latlong = (intensity: number): Environment => ({
  type: 'latlong',
  width: 2,
  height: 1,
  data: Float32Array.of(1, 1, 1, 5, 5, 5),
  intensity,
});

const SCENES: readonly (readonly [string, (scene: Scene) => void])[] = [
  ['nothing but a matt surface', () => {}],
  ['an environment', (scene) => (scene.environment = latlong(1))],
  ['a dark environment image', (scene) => (scene.environment = latlong(0))],
  [
    'a lamp of each kind',
    (scene) =>
      scene.lights.push(
        { type: 'point', name: 'point', color: [1, 1, 1], intensity: 1, position: [0, 0, 2] },
        { type: 'sphere', name: 'sphere', color: [1, 1, 1], intensity: 1, position: [0, 0, 2], radius: 0.1 },
      ),
  ],
  [
    'a glowing surface in a light group',
    (scene) =>
      void addQuad(scene, 0.5, 1, { name: 'glow', light_group: 'glow', parameters: { emission_luminance: 3 } }),
  ],
  [
    'a glowing surface that is hidden',
    (scene) => {
      addQuad(scene, 0.5, 1, { name: 'glow', parameters: { emission_luminance: 3 } });
      scene.instances.at(-1)!.visible = false;
    },
  ],
  ['a catcher', (scene) => (scene.instances[0]!.catcher = true)],
  [
    'painted vertices, some of them clear',
    (scene) => (scene.meshes[0]!.colors = Float32Array.from({ length: 16 }, (_, i) => (i === 3 ? 0.5 : 1))),
  ],
  [
    'a textured, half transparent, anisotropic surface',
    (scene) => {
      scene.images.push({ name: 'image', width: 2, height: 2, data: new Uint8Array(16).fill(200) });
      scene.textures.push({ image: 0, color_space: 'srgb' });
      scene.materials[0] = {
        name: 'cloth',
        parameters: { geometry_opacity: 0.5, specular_roughness_anisotropy: 0.4 },
        textures: { base_color: { texture: 0, channels: 'rgb' } },
      };
    },
  ],
  [
    'a smooth ball of glass',
    (scene) => addSphere(scene, 0.5, [0, 0, 0], { name: 'glass', parameters: { transmission_weight: 1 } }, 8),
  ],
];

it.each(SCENES)(
  'kernels that begin to compile before hierarchies are built are those of the scene: %s',
  async (_, change) => {
    const scene = plain();
    change(scene);
    const memory = new GpuMemory(device);
    try {
      const gpuScene = new GpuScene(device, memory, scene, await prepareGeometry(scene), CHOICES);
      await gpuScene.light(prepareEnvironment(scene.environment), energyTextures(OPENPBR_TABLES));
      expect(expectedFeatures(device, scene, CHOICES)).toEqual(gpuScene.features());
    } finally {
      memory.destroy();
    }
  },
);

it('each kernel compiles once, and a scene that was taken for another still gets its own', async () => {
  const compiled: string[] = [];
  const watched = new Proxy(device, {
    get: (target, name) => {
      const value = Reflect.get(target, name) as unknown;
      if (name === 'createComputePipelineAsync') {
        return (descriptor: GPUComputePipelineDescriptor) => {
          compiled.push(descriptor.label!);
          return target.createComputePipelineAsync(descriptor);
        };
      }
      return typeof value === 'function' ? (value as () => unknown).bind(target) : value;
    },
  });
  const create = async (scene: Scene) => {
    const tracer = await PathTracer.create(watched, scene, { width: 4, height: 4, camera });
    for await (const progress of tracer.render({ samples: 1 })) void progress;
    const { compileMs } = tracer.statistics;
    tracer.destroy();
    return compileMs;
  };
  expect(await create(plain())).toBeGreaterThan(0);
  expect(new Set(compiled).size).toBe(compiled.length);
  expect(compiled.length).toBeGreaterThan(4);
  // A lamp without power is no lamp.
  const dark = plain();
  dark.lights.push({ type: 'point', name: 'off', color: [0, 0, 0], intensity: 0, position: [0, 0, 2] });
  compiled.length = 0;
  await create(dark);
  // The guess's connect and shade were for nothing; the rest is there already.
  expect(new Set(compiled).size).toBe(compiled.length);
});

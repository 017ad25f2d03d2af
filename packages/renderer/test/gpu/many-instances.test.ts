import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { OPENPBR_TABLES } from '@glanz/openpbr/tables';
import { createScene, type Instance, type Scene } from '@glanz/scene';
import { afterEach, beforeAll, expect, it } from 'vitest';
import { GpuMemory } from '../../src/gpu/buffers';
import { energyTextures } from '../../src/gpu/energy-textures';
import { GpuScene } from '../../src/gpu/gpu-scene';
import { PathTracer } from '../../src/index';
import { prepareEnvironment } from '../../src/scene/environment';
import { expectedFeatures, type SceneChoices } from '../../src/scene/features';
import { prepareGeometry } from '../../src/scene/geometry';
import { addBox, camera, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

const CHOICES: SceneChoices = { multipleScattering: true, sampler: 'blue-noise', lightGroups: 'named', lightSampling: 'tree', shadowTerminator: 'smooth', backFaceCulling: 'all' };

/** Boxes of one mesh in a cube, in as many materials as asked for. */
function boxes(count: number, materials: number): Scene {
  const scene = createScene();
  addBox(scene, [-0.4, -0.4, -0.4], [0.4, 0.4, 0.4], lambert(0.5));
  scene.materials = Array.from({ length: materials }, (_, i) => ({ ...lambert(i / materials), name: `material ${i}` }));
  const side = Math.ceil(Math.cbrt(count));
  scene.instances = Array.from({ length: count }, (_, i) => ({
    name: `box ${i}`,
    mesh: 0,
    material: i % materials,
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, i % side, Math.floor(i / side) % side, -Math.floor(i / side ** 2), 1],
  }));
  return scene;
}

/** Puts a list in the place of the scene's instances that counts how often one of them is read. */
function countReads(scene: Scene): { reads: number } {
  const counter = { reads: 0 };
  scene.instances = new Proxy<Instance[]>(scene.instances, {
    get(list, key) {
      if (typeof key === 'string' && /^\d+$/.test(key)) counter.reads++;
      return Reflect.get(list, key) as unknown;
    },
  });
  return counter;
}

it('preparing a scene reads each instance a bounded number of times, however many instances and materials there are', async () => {
  const scene = boxes(1000, 100);
  scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  const counter = countReads(scene);
  const memory = new GpuMemory(device);
  try {
    const expected = expectedFeatures(device, scene, CHOICES);
    const gpuScene = new GpuScene(device, memory, scene, await prepareGeometry(scene), CHOICES);
    await gpuScene.fill();
    await gpuScene.light(prepareEnvironment(scene.environment), energyTextures(OPENPBR_TABLES));
    expect(gpuScene.features()).toEqual(expected);
    expect(counter.reads / 1000).toBeGreaterThanOrEqual(1);
    expect(counter.reads / 1000).toBeLessThan(50);
  } finally {
    memory.destroy();
  }
});

it('a camera move reads no instance and derives no features', async () => {
  const tracer = await PathTracer.create(device, boxes(100, 10), { width: 8, height: 8, camera });
  const counter = countReads(tracer.scene);
  await tracer.setCamera({ ...camera, yfov: 1 });
  for await (const _ of tracer.render({ samples: 1 }));
  expect(counter.reads).toBe(0);
  tracer.destroy();
});

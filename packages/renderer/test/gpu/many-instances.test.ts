import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { OPENPBR_TABLES } from '@glanz/openpbr/tables';
import { createScene, type Instance, type Scene } from '@glanz/scene';
import { afterEach, beforeAll, expect, it } from 'vitest';
import { GpuMemory } from '../../src/storage/buffers';
import { energyTextures } from '../../src/materials/energy-textures';
import { GpuScene } from '../../src/scene/gpu-scene';
import { PathTracer } from '../../src/index';
import { prepareEnvironment } from '../../src/environment/environment';
import { expectedFeatures, type SceneChoices } from '../../src/scene/features';
import { prepareGeometry } from '../../src/geometry/prepare-geometry';
import { addBox, addQuad, addSphere, camera, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

const CHOICES: SceneChoices = {
  guiding: 0,
  multipleScattering: true,
  sampler: 'blue-noise',
  lightGroups: 'named',
  lightSampling: 'tree',
  shadowTerminator: 'smooth',
  backFaceCulling: 'all',
};

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
    transform: [
      1,
      0,
      0,
      0,
      0,
      1,
      0,
      0,
      0,
      0,
      1,
      0,
      i % side,
      Math.floor(i / side) % side,
      -Math.floor(i / side ** 2),
      1,
    ],
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

const at = (x: number, y: number, z: number, size = 1) => [size, 0, 0, 0, 0, size, 0, 0, 0, 0, size, 0, x, y, z, 1];

/** Bytes that are written to the GPU's buffers while something runs. */
async function bytesWritten(run: () => Promise<unknown>): Promise<number> {
  const original = device.queue.writeBuffer.bind(device.queue);
  let bytes = 0;
  device.queue.writeBuffer = (...args: Parameters<GPUQueue['writeBuffer']>) => {
    bytes += args[4] ?? (args[2] as ArrayBuffer).byteLength;
    original(...args);
  };
  try {
    await run();
  } finally {
    device.queue.writeBuffer = original;
  }
  return bytes;
}

it('an edit of one instance reads and writes what it touches, not the others', async () => {
  const scene = boxes(3000, 10);
  // One that glows: another edit must not gather the lights again.
  scene.materials.push({ name: 'glow', parameters: { emission_luminance: 3 } });
  scene.instances[5]!.material = 10;
  scene.lights.push({ type: 'point', name: 'lamp', color: [1, 1, 1], intensity: 1, position: [0, 0, 3] });
  const tracer = await PathTracer.create(device, scene, { width: 8, height: 8, camera });
  // The first look-up by name lists the names.
  await tracer.setVisibility('box 7', true);
  const counter = countReads(tracer.scene);
  const edits: Readonly<Record<string, () => Promise<void>>> = {
    hidden: () => tracer.setVisibility(1234, false),
    shown: () => tracer.setVisibility(1234, true),
    'hidden by name': () => tracer.setVisibility('box 321', false),
    'two shown by name': () => tracer.setVisibility(['box 321', 'box 322'], true),
    'moved a little': () => tracer.setInstanceTransform(1500, at(0.1, 0.2, -0.3)),
    'moved far': () => tracer.setInstanceTransform(1500, at(7, 8, -9)),
    'another material': () => tracer.setInstanceMaterial(1500, 3),
    'a value of a material': () => tracer.setMaterial(3, { specular_roughness: 0.4 }),
  };
  for (const [name, edit] of Object.entries(edits)) {
    counter.reads = 0;
    const bytes = await bytesWritten(edit);
    // All records take 480,000 bytes, all nodes 192,000.
    expect([name, counter.reads < 40, bytes > 0, bytes < 30_000]).toEqual([name, true, true, true]);
  }
  tracer.destroy();
});

/** A linear congruential generator, 0..1. */
const randomNumbers = (seed: number) => () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) / 2 ** 32;

it('after hundreds of edits the image and what a click finds are those of a new tracer (seed 91)', async () => {
  const random = randomNumbers(91);
  const scene = boxes(150, 6);
  addSphere(scene, 0.4, [0, 0, 0], lambert(0.8, 0.3, 0.2), 10);
  addQuad(scene, 3, -2, lambert(0.7));
  scene.materials.push({ name: 'glow', parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 4 } });
  const [round, floor, glow] = [6, 7, 8];
  for (let i = 0; i < 150; i++) if (i % 3 === 0) scene.instances[i]!.mesh = 1;
  scene.instances.forEach((instance, i) => {
    if (i < 150)
      Object.assign(instance, {
        transform: at(2 * random() - 1, 2 * random() - 1, -2 * random(), 0.3),
        visible: i % 5 !== 0,
      });
    if (i % 40 === 1) instance.material = glow;
  });
  scene.lights.push({ type: 'directional', name: 'sun', color: [1, 1, 1], intensity: 1, direction: [0.3, -0.2, -1] });
  scene.environment = { type: 'constant', radiance: [0.3, 0.4, 0.5] };
  const options = { width: 24, height: 24, camera, pathsInFlight: 1 << 13, maxDepth: 3 };
  const image = async (tracer: PathTracer) => {
    for await (const _ of tracer.render({ samples: 4, maxSubmitMs: 1000 }));
    return tracer.read('beauty');
  };
  const tracer = await PathTracer.create(device, scene, options);
  let before = await image(tracer);
  for (let stage = 0; stage < 3; stage++) {
    for (let turn = 0; turn < 60; turn++) {
      const i = Math.floor(150 * random()),
        kind = random();
      if (kind < 0.4) await tracer.setInstanceTransform(i, at(2 * random() - 1, 2 * random() - 1, -2 * random(), 0.3));
      else if (kind < 0.7) await tracer.setVisibility(i, tracer.scene.instances[i]!.visible === false);
      else await tracer.setInstanceMaterial(i, kind < 0.75 ? glow : kind < 0.8 ? round : Math.floor(6 * random()));
    }
    // With catchers there is a second hierarchy, of what belongs to the environment.
    if (stage === 1) await tracer.setCatcher(scene.instances.length - 1, true);
    if (stage === 1) await tracer.setMaterial(glow, { emission_luminance: 0 });
    if (stage === 2) await tracer.setMaterial(glow, { emission_luminance: 2 });
    const after = await image(tracer);
    const fresh = await PathTracer.create(device, tracer.scene, options);
    const expected = await image(fresh);
    const largest = (a: Float32Array, b: Float32Array) =>
      a.reduce((max, value, i) => Math.max(max, Math.abs(value - b[i]!)), 0);
    expect(largest(after, before)).toBeGreaterThan(1e-2);
    expect(largest(after, expected)).toBeLessThan(1e-5);
    for (let k = 0; k < 40; k++) {
      const [x, y] = [24 * random(), 24 * random()];
      expect(tracer.pick(x, y)).toEqual(fresh.pick(x, y));
    }
    expect(tracer.statistics.instances).toBe(fresh.statistics.instances);
    fresh.destroy();
    before = after;
  }
  expect(floor).toBe(tracer.scene.instances.at(-1)!.material);
  tracer.destroy();
});

it('a refused edit of many leaves the hierarchy as it was', async () => {
  const tracer = await PathTracer.create(device, boxes(100, 4), { width: 8, height: 8, camera });
  const points = Array.from({ length: 64 }, (_, i) => [i % 8, Math.floor(i / 8)] as const);
  const found = () => points.map(([x, y]) => tracer.pick(x, y));
  const before = found();
  expect(before.filter((hit) => hit).length).toBeGreaterThan(3);
  await expect(tracer.setVisibility([...tracer.scene.instances.keys()], false)).rejects.toMatchObject({
    code: 'renderer/no-triangles',
  });
  expect(found()).toEqual(before);
  expect(tracer.scene.instances.every(({ visible }) => visible !== false)).toBe(true);
  await tracer.setVisibility(0, false);
  expect(tracer.statistics.instances).toBe(99);
  tracer.destroy();
});

it('an opaque material shows what is behind at once on a mesh whose vertex colours let light pass', async () => {
  const scene = createScene();
  addQuad(scene, 0.9, 0, lambert(0.7));
  addQuad(scene, 0.5, 0.5, lambert(0.1));
  scene.meshes[1]!.colors = Float32Array.from({ length: 16 }, (_, i) => (i % 4 === 3 ? 0.25 : 1));
  scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  const options = { width: 8, height: 8, camera };
  const image = async (tracer: PathTracer) => {
    for await (const _ of tracer.render({ samples: 4 }));
    const pixels = await tracer.read('beauty');
    tracer.destroy();
    return pixels;
  };
  const edited = await PathTracer.create(device, scene, options);
  await edited.setInstanceMaterial(1, 0);
  const assigned = { ...scene, instances: scene.instances.map((instance) => ({ ...instance, material: 0 })) };
  const [after, expected] = [await image(edited), await image(await PathTracer.create(device, assigned, options))];
  expect(after.every((value, i) => Math.abs(value - expected[i]!) < 1e-5)).toBe(true);
});

/** How often the GPU is asked whether it accepts something. */
async function checksOf(run: () => Promise<unknown>): Promise<number> {
  const original = device.pushErrorScope.bind(device);
  let checks = 0;
  device.pushErrorScope = (filter) => {
    checks++;
    original(filter);
  };
  try {
    await run();
  } finally {
    device.pushErrorScope = original;
  }
  return checks;
}

it('many instances move as one edit: the same film as by an edit each, and the GPU checks as often as for one', async () => {
  const film = async (move: (tracer: PathTracer, list: [number, number[]][]) => Promise<unknown>) => {
    const scene = boxes(300, 10);
    scene.environment = { type: 'constant', radiance: [1, 1, 1] };
    const tracer = await PathTracer.create(device, scene, { width: 16, height: 16, camera });
    const list = Array.from({ length: 200 }, (_, i): [number, number[]] => [
      i,
      at(0.5 * (i % 7), 0.25 * Math.floor(i / 7), -3, 0.2),
    ]);
    const checks = await checksOf(() => move(tracer, list));
    for await (const _ of tracer.render({ samples: 2 }));
    const beauty = await tracer.read('beauty');
    tracer.destroy();
    return { checks, beauty };
  };
  const together = await film((tracer, list) => tracer.setInstanceTransforms(list));
  const one = await film((tracer, list) => tracer.setInstanceTransforms(list.slice(0, 1)));
  const each = await film((tracer, list) =>
    Promise.all(list.map(([index, place]) => tracer.setInstanceTransform(index, place))),
  );
  expect(together.checks).toBe(one.checks);
  expect(each.checks).toBe(200 * one.checks);
  expect(together.beauty).toEqual(each.beauty);
  expect(together.beauty).not.toEqual(one.beauty);
});

it('of several moves none is made where one is invalid; of two of one instance the last counts', async () => {
  const tracer = await PathTracer.create(device, boxes(3, 1), { width: 8, height: 8, camera });
  const places = () => tracer.scene.instances.map(({ transform }) => transform);
  const before = places();
  await expect(
    tracer.setInstanceTransforms([
      [0, at(5, 0, 0)],
      ['box 9', at(6, 0, 0)],
    ]),
  ).rejects.toMatchObject({ code: 'renderer/instance' });
  await expect(tracer.setInstanceTransforms([[0, [1, 2, 3]]])).rejects.toMatchObject({ code: 'renderer/transform' });
  expect(places()).toEqual(before);
  await tracer.setInstanceTransforms([
    ['box 1', at(5, 0, 0)],
    [1, at(6, 0, 0)],
  ]);
  expect(places()).toEqual([before[0], at(6, 0, 0), before[2]]);
  tracer.destroy();
});

it('a list of no moves leaves the film as it is', async () => {
  const scene = boxes(3, 1);
  scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  const tracer = await PathTracer.create(device, scene, { width: 8, height: 8, camera });
  for await (const _ of tracer.render({ samples: 2 }));
  const before = await tracer.read('beauty');
  await tracer.setInstanceTransforms([]);
  expect(tracer.samples).toBe(2);
  expect(await tracer.read('beauty')).toEqual(before);
  tracer.destroy();
});

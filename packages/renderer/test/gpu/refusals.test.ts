import { FaultRecorder, instrumentDevice, type Fault } from '@glanz/gpu/faults';
import { createGpu } from '@glanz/renderer/node';
import type { LatLongEnvironment, Mesh, Scene } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, requestDevice, type PathTracerOptions } from '../../src/index';
import { addQuad, addSphere, camera, createScene, lambert } from '../scenes';

const options: PathTracerOptions = {
  width: 16,
  height: 12,
  camera,
  pathsInFlight: 1 << 12,
  maxDepth: 3,
  lightGroups: 'off',
};
const recorder = new FaultRecorder();
let device: GPUDevice;
beforeAll(async () => {
  const { gpu } = await createGpu({ software: 'only' });
  device = instrumentDevice(await requestDevice({ gpu }), recorder);
});
afterAll(() => device.destroy());

const sky = (width: number): LatLongEnvironment => ({
  type: 'latlong',
  width,
  height: width / 2,
  data: Float32Array.from({ length: (3 * width * width) / 2 }, (_, i) => (i % 97 === 3 ? 4 : 0.2)),
});

function stage(): Scene {
  const scene = createScene();
  addQuad(scene, 0.9, 0, lambert(0.6, 0.5, 0.4));
  addSphere(
    scene,
    0.3,
    [0, 0, 0.3],
    { name: 'ball', parameters: { base_color: [0.8, 0.2, 0.1], specular_roughness: 0.3 } },
    8,
  );
  (scene.instances[0] as { name: string }).name = 'floor';
  scene.environment = sky(8);
  return scene;
}

const larger = (): Mesh => {
  const scene = createScene();
  addSphere(scene, 0.5, [0.2, 0, 0.5], lambert(1), 24);
  return scene.meshes[0] as Mesh;
};

async function image(tracer: PathTracer, samples = 6): Promise<Float32Array> {
  for await (const progress of tracer.render({ samples })) void progress;
  return tracer.read('beauty');
}

/** A name, the edit, and the GPU calls that it makes of which one is to fail. */
const EDITS: readonly (readonly [string, (tracer: PathTracer) => Promise<void>, RegExp, Fault])[] = [
  ['a larger environment', (t) => t.setEnvironment(sky(32)), /^createTexture/, 'out-of-memory'],
  ['no environment', (t) => t.setEnvironment(undefined), /^createTexture/, 'out-of-memory'],
  ['a larger mesh', (t) => t.replaceMesh('sphere', larger()), /^createBuffer/, 'out-of-memory'],
  ['the first that emits', (t) => t.setMaterial('ball', { emission_luminance: 3 }), /^createBuffer/, 'out-of-memory'],
  ['the first catcher', (t) => t.setCatcher('floor', true), /^createBuffer/, 'out-of-memory'],
  [
    'a lobe whose kernel does not compile',
    (t) => t.setMaterial('ball', { coat_weight: 1, coat_roughness: 0.123 }),
    /^createComputePipelineAsync/,
    'compile',
  ],
  [
    'a lens whose kernel does not compile',
    (t) => t.setCamera({ ...camera, lens_radius: 0.05 }),
    /^createComputePipelineAsync/,
    'compile',
  ],
  [
    'a transform',
    (t) => t.setInstanceTransform('sphere', [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.4, 0, 0, 1]),
    /^writeBuffer "glanz (nodes|instances|lights|materials)"/,
    'validation',
  ],
  ['a size', (t) => t.resize(20, 10), /^createBuffer/, 'out-of-memory'],
];

describe('an edit that the GPU refuses', () => {
  it.each(EDITS)('%s: rejects, changes nothing, and holds when it is made again', async (name, edit, calls, fault) => {
    const plain = await PathTracer.create(device, stage(), options);
    const before = await image(plain);
    const points: string[] = [];
    // A compiled kernel is kept for the device, and could not fail again: those edits are tried once, with the fault.
    const compiles = fault === 'compile';
    if (!compiles) {
      recorder.clear();
      await edit(plain);
      points.push(...recorder.points.filter((point) => calls.test(point.name)).map((point) => point.name));
      expect(points.length).toBeGreaterThan(0);
    } else {
      points.push(`createComputePipelineAsync "glanz ${name.includes('lens') ? 'generate' : 'shade'}" #1 in start`);
    }
    const expected = compiles ? undefined : await image(plain);
    plain.destroy();
    let struck = 0;
    for (const point of points) {
      const tracer = await PathTracer.create(device, stage(), options);
      await image(tracer, 3);
      recorder.clear({ point, fault });
      const error = await edit(tracer).then(
        () => undefined,
        (thrown: Error & { code?: string }) => thrown,
      );
      if (!recorder.struck) {
        tracer.destroy();
        continue;
      }
      struck++;
      expect(error?.code, `${name}: ${point}: ${error?.stack}`).toMatch(
        /^renderer\/(out-of-memory|gpu-error)$|^wgsl\//,
      );
      expect([tracer.width, tracer.height]).toEqual([16, 12]);
      // Where the GPU refuses memory, the film goes on: its samples are kept.
      if (fault === 'out-of-memory' && !/paths|shadows|film/.test(point)) expect(tracer.samples, point).toBe(3);
      expect(await image(tracer), `${name}: ${point}, afterwards`).toEqual(before);
      await edit(tracer);
      const after = await image(tracer);
      expect(after).not.toEqual(before);
      if (expected) expect(after, `${name}: ${point}, again`).toEqual(expected);
      tracer.destroy();
    }
    expect(struck).toBeGreaterThan(0);
    expect(recorder.uncaptured).toEqual([]);
    expect(recorder.live.size).toBe(0);
  });
});

it('frames that reuse light samples reject where there is no memory for these, and come when there is', async () => {
  const make = async () => {
    const tracer = await PathTracer.create(device, stage(), options);
    await tracer.setLightReuse(true);
    return tracer;
  };
  const frame = (tracer: PathTracer, firstSample: number) => {
    tracer.reset({ firstSample, lightReuse: true });
    return image(tracer, 1);
  };
  const plain = await make();
  recorder.clear();
  await frame(plain, 1);
  const points = recorder.points.filter(({ name }) => name.startsWith('createTexture "glanz light samples'));
  expect(points.length).toBeGreaterThan(5);
  const expected = await frame(plain, 2);
  plain.destroy();
  for (const { name } of points.slice(0, 4)) {
    const tracer = await make();
    recorder.clear({ point: name, fault: 'out-of-memory' });
    const error = await frame(tracer, 1).catch((thrown: Error & { code?: string }) => thrown);
    expect(recorder.struck, name).toBeTruthy();
    expect(error, name).toMatchObject({ code: 'renderer/out-of-memory' });
    await frame(tracer, 1);
    expect(await frame(tracer, 2), name).toEqual(expected);
    tracer.destroy();
  }
  expect(recorder.uncaptured).toEqual([]);
  expect(recorder.live.size).toBe(0);
});

it('layers that are made on demand reject, and come when they are read again', async () => {
  const tracer = await PathTracer.create(device, stage(), options);
  const beauty = await image(tracer);
  for (const layer of ['albedo', 'normal', 'position', 'depth', 'objectId', 'variance', 'beauty'] as const) {
    recorder.clear();
    const expected = await tracer.read(layer);
    const points = [...new Set(recorder.points.filter(({ call }) => call === 'createBuffer').map(({ name }) => name))];
    await tracer.resize(17, 12);
    await tracer.resize(16, 12);
    await image(tracer);
    for (const point of points) {
      recorder.clear({ point, fault: 'out-of-memory' });
      const outcome = await tracer.read(layer).then(
        () => undefined,
        (error: unknown) => error,
      );
      if (recorder.struck) expect(outcome, point).toMatchObject({ code: 'renderer/out-of-memory' });
      expect(await tracer.read(layer), `${layer}: ${point}`).toEqual(expected);
    }
  }
  expect(await tracer.read('beauty')).toEqual(beauty);
  recorder.clear({ point: 'mapAsync "glanz read" #1 in start', fault: 'map' });
  await expect(tracer.read('beauty')).rejects.toMatchObject({ code: 'renderer/gpu-error' });
  expect(await tracer.read('beauty')).toEqual(beauty);
  tracer.destroy();
  expect(recorder.uncaptured).toEqual([]);
});

it('a batch that the GPU refuses is reported, and the next render gives the whole image', async () => {
  const tracer = await PathTracer.create(device, stage(), options);
  const expected = await image(tracer);
  await tracer.setMaterial('ball', { specular_roughness: 0.3 });
  recorder.clear({ point: 'submit "" #2 in start', fault: 'validation' });
  await expect(image(tracer, 40)).rejects.toMatchObject({ code: 'renderer/gpu-error' });
  expect(await image(tracer)).toEqual(expected);
  tracer.destroy();
});

it('a GPU that has no memory for more paths at once renders the same image in smaller batches', async () => {
  const large: PathTracerOptions = { ...options, width: 150, height: 100, pathsInFlight: 1 << 21 };
  const plain = await PathTracer.create(device, stage(), large);
  recorder.clear();
  for await (const progress of plain.render({ samples: 24, maxSubmitMs: 4000 })) void progress;
  const expected = await plain.read('beauty');
  const grown = recorder.points.filter(({ name }) => name.startsWith('createBuffer "glanz paths"'));
  expect(grown.length).toBeGreaterThan(0);
  plain.destroy();
  const tracer = await PathTracer.create(device, stage(), large);
  recorder.clear({ point: 'createBuffer "glanz paths" #1 in start', fault: 'out-of-memory' });
  for await (const progress of tracer.render({ samples: 24, maxSubmitMs: 4000 })) void progress;
  expect(recorder.struck).toBeDefined();
  expect(await tracer.read('beauty')).toEqual(expected);
  tracer.destroy();
  expect(recorder.uncaptured).toEqual([]);
});

it('memory for light paths of more samples at once is refused: the film goes on without, and is the same', async () => {
  const glass = stage();
  const parameters = { transmission_weight: 1, specular_roughness: 0 };
  addSphere(glass, 0.2, [0.4, 0, 0.4], { name: 'glass', parameters }, 8);
  const traced = async () => {
    const tracer = await PathTracer.create(device, glass, { ...options, lightPaths: 0.5 });
    // The second batch has several samples.
    await image(tracer, 1);
    await image(tracer, 12);
    const film = await image(tracer, 24);
    tracer.destroy();
    return film;
  };
  recorder.clear();
  const expected = await traced();
  const sums = recorder.points.filter(({ name }) => name.startsWith('createBuffer "glanz light paths"'));
  expect(sums.length).toBeGreaterThan(1);
  for (const { name: point } of sums.slice(1)) {
    recorder.clear({ point, fault: 'out-of-memory' });
    expect(await traced(), point).toEqual(expected);
    expect(recorder.struck, point).toBeTruthy();
  }
  expect(recorder.uncaptured).toEqual([]);
});

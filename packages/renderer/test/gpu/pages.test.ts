import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Instance, Mesh, Scene } from '@glanz/scene';
import { poseMesh } from '@glanz/scene/pose';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { shapeBytes } from '../../src/geometry/geometry';
import { prepareGeometry } from '../../src/geometry/prepare-geometry';
import { DeviceError } from '../../src/errors';
import { buildOnGpu } from '../../src/geometry/gpu-trees';
import { GpuMemory } from '../../src/storage/buffers';
import { Pages } from '../../src/storage/paged/pages';
import { readAov } from '../aovs';
import { gallery, limited, place, SMALL } from '../gallery';
import { poseOf, rigOf } from '../rigs';
import { addSphere, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});
afterEach(() => expectNoGpuErrors());

const WIDTH = 24;
const options: PathTracerOptions = { width: WIDTH, height: WIDTH, camera, pathsInFlight: 1 << 10, maxDepth: 5 };

async function film(tracer: PathTracer, samples = 4) {
  for await (const _ of tracer.render({ samples, maxSubmitMs: 1000 }));
  return tracer.read('beauty');
}

async function fresh(on: GPUDevice, scene: Scene, over: Partial<PathTracerOptions> = {}) {
  const tracer = await PathTracer.create(on, scene, { ...options, ...over });
  try {
    return await film(tracer);
  } finally {
    tracer.destroy();
  }
}

const moved = (scene: Scene, name: string, change: Partial<Instance>): Scene => ({
  ...scene,
  instances: scene.instances.map((instance) => (instance.name === name ? { ...instance, ...change } : instance)),
});

describe('arrays larger than a binding', () => {
  it('lie in textures, and give the film, the AOVs and the picks of buffers bit for bit', async () => {
    const scene = gallery();
    const { device: small, shapes, live } = limited(device);
    const aovs = ['normal', 'objectId'] as const;
    const make = (on: GPUDevice) => PathTracer.create(on, scene, { ...options, aovs });
    const [paged, plain] = await Promise.all([make(small), make(device)]);
    expect(shapes()).toEqual(['texture attributes', 'texture nodes', 'texture triangles']);
    expect(await film(paged)).toEqual(await film(plain));
    for (const name of aovs)
      expect(await readAov(small, paged, name), name).toEqual(await readAov(device, plain, name));
    for (let y = 0.5; y < WIDTH; y += 3)
      for (let x = 0.5; x < WIDTH; x += 3) expect(paged.pick(x, y)).toEqual(plain.pick(x, y));
    // Textures have whole rows and layers.
    const [{ memory: own }, { memory: other }] = [paged.statistics, plain.statistics];
    expect(own.shapes).toBeGreaterThanOrEqual(other.shapes);
    expect(own.shapes).toBeLessThan(1.5 * other.shapes);
    expect(own.other).toBe(other.other);
    for (const tracer of [paged, plain]) tracer.destroy();
    expect([...live.values()]).toEqual([]);
  });

  /** Balls of few triangles, each of which a GPU with small bindings can build. */
  function balls(): Scene {
    const scene = createScene();
    for (let i = 0; i < 9; i++)
      addSphere(scene, 0.2, [(i % 3) / 2 - 0.5, (i - (i % 3)) / 6 - 0.5, 0], lambert(0.7), 20);
    scene.environment = { type: 'constant', radiance: [0.6, 0.7, 0.8] };
    return scene;
  }

  it('follow edits', async () => {
    let scene = balls();
    for (const [i, instance] of scene.instances.entries())
      Object.assign(instance, { name: `ball ${i}`, visible: i !== 8 });
    const { device: small, shapes, live } = limited(device);
    const tracer = await PathTracer.create(small, scene, options);
    const check = async () => {
      expect(shapes()).toEqual(['texture attributes', 'texture nodes', 'texture triangles']);
      expect(await film(tracer)).toEqual(await fresh(device, scene));
    };
    await check();
    // Nodes of the upper levels and a record.
    scene = moved(scene, 'ball 1', { transform: place(0.1, 0.1, 0.4, 0.7) });
    await tracer.setInstanceTransform('ball 1', place(0.1, 0.1, 0.4, 0.7));
    await check();
    // A mesh that was not shown before: all is laid out again.
    scene = moved(scene, 'ball 8', { visible: true });
    await tracer.setVisibility('ball 8', true);
    await check();
    // A smaller mesh that is written into the region of the one before, and a larger one that does not fit there.
    for (const segments of [12, 28]) {
      const other = createScene();
      addSphere(other, 0.25, [0, 0, 0.2], lambert(0.5), segments);
      await tracer.replaceMesh(4, other.meshes[0] as Mesh);
      scene = { ...scene, meshes: scene.meshes.map((mesh, i) => (i === 4 ? other.meshes[0]! : mesh)) };
      await check();
    }
    tracer.destroy();
    expect([...live.values()]).toEqual([]);
  });

  it('take hierarchies that were built on the GPU, and give them back for edits', async () => {
    const scene = balls();
    const { device: small, shapes } = limited(device);
    const tracer = await PathTracer.create(small, scene, { ...options, bvhBuilder: 'gpu' });
    expect(tracer.statistics.builds).toEqual([expect.objectContaining({ where: 'gpu', meshes: 9 })]);
    expect(shapes()).toEqual(['texture attributes', 'texture nodes', 'texture triangles']);
    expect(await film(tracer)).toEqual(await fresh(device, scene, { bvhBuilder: 'gpu' }));
    const other = createScene();
    addSphere(other, 0.3, [0, 0, 0.2], lambert(0.5), 24);
    await tracer.replaceMesh(4, other.meshes[0] as Mesh);
    const edited = { ...scene, meshes: scene.meshes.map((mesh, i) => (i === 4 ? other.meshes[0]! : mesh)) };
    expect(await film(tracer)).toEqual(await fresh(device, edited, { bvhBuilder: 'cpu' }));
    tracer.destroy();
  });

  it('are read back as they were when that was asked for, whatever is written meanwhile', async () => {
    const scene = balls();
    const { device: small } = limited(device);
    const memory = new GpuMemory(small);
    const signal = new AbortController().signal;
    const builds = { device: small, memory, minTriangles: 1, minInstances: 1 };
    const mesh = scene.meshes[0] as Mesh;
    const build = async () => {
      const { trees } = await buildOnGpu(builds, [mesh], { signal, onProgress: () => undefined });
      return trees[0]!.gpu!;
    };
    const { nodes: expected, nodeCount } = await (await build()).read();
    const placed = await build();
    const region = {
      firstNode: 1,
      nodes: nodeCount,
      firstTriangle: 0,
      triangles: 0,
      firstVertex: 0,
      vertices: 0,
      firstWord: 0,
      words: 0,
    };
    const bytes = { nodes: 64 * (nodeCount + 1), triangles: 1 << 20, attributes: 1 << 20 };
    const pages = new Pages(small, bytes, 16, DeviceError);
    const arrays = {
      nodes: pages.make(memory, 'nodes', bytes.nodes)!,
      triangles: pages.make(memory, 'triangles', bytes.triangles)!,
      attributes: pages.make(memory, 'attributes', bytes.attributes)!,
    };
    placed.place((name) => arrays[name], region);
    const reading = placed.read();
    arrays.nodes.write(new Uint8Array(64 * nodeCount), 64);
    expect((await reading).nodes).toEqual(expected);
    memory.destroy();
  });

  it('take poses that are computed on the GPU', async () => {
    const rig = rigOf(16);
    const scene = createScene();
    addSphere(scene, 0.2, [-0.5, -0.5, 0.2], lambert(0.7), 48);
    scene.meshes.push(rig.bind);
    scene.instances.push({ ...(scene.instances[0] as Instance), name: 'body', mesh: 1 });
    scene.environment = { type: 'constant', radiance: [0.5, 0.6, 0.7] };
    const { device: small, shapes } = limited(device);
    const images = await Promise.all(
      [small, device].map(async (on) => {
        const tracer = await PathTracer.create(on, scene, { ...options, bvhBuilder: 'gpu' });
        for (const angle of [0, 0.4, 0.9]) await tracer.replaceMesh('body', poseMesh(rig, poseOf(angle, [0.3])));
        const pixels = await film(tracer);
        if (on === small) expect(shapes()).toEqual(TEXTURES);
        tracer.destroy();
        return pixels;
      }),
    );
    expect(images[0]).toEqual(images[1]);
  });

  it('lie in textures alone: the others stay in buffers', async () => {
    const scene = balls();
    const bytes = shapeBytes(scene, await prepareGeometry(scene));
    const expected = await fresh(device, scene);
    const [first, second, third] = (Object.entries(bytes) as [string, number][]).sort(([, a], [, b]) => a - b);
    for (const [limit, large] of [
      [first![1], [second![0], third![0]]],
      [second![1], [third![0]]],
      [third![1], []],
    ] as const) {
      const maxStorageBufferBindingSize = 16 * Math.ceil(limit / 16);
      const { device: small, shapes } = limited(device, { ...SMALL, maxStorageBufferBindingSize });
      const tracer = await PathTracer.create(small, scene, options);
      const kinds = ['nodes', 'triangles', 'attributes'].map(
        (name) => `${(large as readonly string[]).includes(name) ? 'texture' : 'buffer'} ${name}`,
      );
      expect(shapes()).toEqual(kinds.sort());
      expect(await film(tracer)).toEqual(expected);
      tracer.destroy();
    }
  });

  it('are refused before anything is made where textures do not hold them, with the numbers', async () => {
    const made: string[] = [];
    const { device: small } = limited(device, { ...SMALL, maxTextureArrayLayers: 2 });
    const watched = new Proxy(small, {
      get(target, name) {
        const value = Reflect.get(target, name) as unknown;
        if (typeof value !== 'function') return value;
        if (typeof name === 'string' && /^create(Buffer|Texture|ComputePipeline)/.test(name)) made.push(name);
        return (value as () => unknown).bind(target);
      },
    });
    const creating = PathTracer.create(watched, balls(), options);
    await expect(creating).rejects.toMatchObject({
      code: 'renderer/limit',
      message: expect.stringMatching(
        /shapes of this scene take \d.* MiB \(nodes .* MiB, triangles .* MiB, attributes .* MiB\), .* 0\.0 MiB/,
      ) as string,
    });
    expect(made).toEqual([]);
  });

  /** A ball in buffers, and one for it whose arrays are larger than a binding. */
  function growing() {
    const scene = createScene();
    addSphere(scene, 0.3, [0, 0, 0], lambert(0.7), 16);
    scene.environment = { type: 'constant', radiance: [0.6, 0.7, 0.8] };
    const other = createScene();
    addSphere(other, 0.4, [0.1, 0, 0], lambert(0.7), 64);
    const mesh = other.meshes[0] as Mesh;
    return { scene, mesh, grown: { ...scene, meshes: [mesh] } };
  }
  const BUFFERS = ['buffer attributes', 'buffer nodes', 'buffer triangles'];
  const TEXTURES = ['texture attributes', 'texture nodes', 'texture triangles'];

  it('grow out of buffers in an edit, also while a render runs, and shrink in textures', async () => {
    const { scene, mesh, grown } = growing();
    const { device: small, shapes, live } = limited(device);
    const aovs = ['normal', 'objectId'] as const;
    const tracer = await PathTracer.create(small, scene, { ...options, aovs });
    expect(shapes()).toEqual(BUFFERS);
    // Kernels that read textures come late: what renders meanwhile must not bind these to the kernels before.
    const create = device.createComputePipelineAsync;
    let late = 0;
    device.createComputePipelineAsync = async (of) => {
      late++;
      await new Promise((resolve) => setTimeout(resolve, 100));
      return create.call(device, of);
    };
    let done = false;
    const edit = tracer.replaceMesh(0, mesh).finally(() => (done = true));
    while (!done) {
      for await (const _ of tracer.render({ samples: 200, maxSubmitMs: 1 }));
      await Promise.race([edit, new Promise((resolve) => setTimeout(resolve, 1))]);
    }
    device.createComputePipelineAsync = create;
    expect(late).toBeGreaterThan(0);
    await edit;
    expect(shapes()).toEqual(TEXTURES);
    expect(await film(tracer)).toEqual(await fresh(device, grown));
    const plain = await PathTracer.create(device, grown, { ...options, aovs });
    await film(plain);
    for (const name of aovs)
      expect(await readAov(small, tracer, name), name).toEqual(await readAov(device, plain, name));
    plain.destroy();
    await tracer.replaceMesh(0, scene.meshes[0] as Mesh);
    expect(shapes()).toEqual(TEXTURES);
    expect(await film(tracer)).toEqual(await fresh(device, scene));
    tracer.destroy();
    expect([...live.values()]).toEqual([]);
  });

  it('grow one by one, and beside edits that are made meanwhile', async () => {
    const { scene, mesh, grown } = growing();
    const bytes = shapeBytes(grown, await prepareGeometry(grown));
    const maxStorageBufferBindingSize = 16 * Math.ceil(Math.max(bytes.nodes, bytes.attributes) / 16);
    expect(bytes.triangles).toBeGreaterThan(maxStorageBufferBindingSize);
    const { device: small, shapes } = limited(device, { ...SMALL, maxStorageBufferBindingSize });
    const tracer = await PathTracer.create(small, scene, options);
    const turned = place(0.2, 0, 0, 0.9);
    await Promise.all([
      tracer.replaceMesh(0, mesh),
      tracer.setMaterial(0, { coat_weight: 1 }),
      tracer.setInstanceTransform(0, turned),
    ]);
    expect(shapes()).toEqual(['buffer attributes', 'buffer nodes', 'texture triangles']);
    const [material, instance] = [grown.materials[0]!, grown.instances[0]!];
    const expected = {
      ...grown,
      materials: [{ ...material, parameters: { ...material.parameters, coat_weight: 1 } }],
      instances: [{ ...instance, transform: turned }],
    };
    expect(await film(tracer)).toEqual(await fresh(device, expected));
    // A mesh beside it: now its nodes are too many as well.
    const larger = createScene();
    addSphere(larger, 0.4, [0, 0, 0], lambert(0.7), 100);
    const next = larger.meshes[0] as Mesh;
    await tracer.replaceMesh(0, next);
    expect(shapes()).toContain('texture nodes');
    expect(await film(tracer)).toEqual(await fresh(device, { ...expected, meshes: [next] }));
    tracer.destroy();
  });

  it('stay in buffers, with the scene as it was, where the grown ones are refused', async () => {
    const { scene, mesh, grown } = growing();
    // What textures of one layer hold is less than the mesh takes.
    const { device: tiny, shapes: shapesOf } = limited(device, { ...SMALL, maxTextureArrayLayers: 1 });
    const first = await PathTracer.create(tiny, scene, options);
    const before = await film(first);
    await expect(first.replaceMesh(0, mesh)).rejects.toMatchObject({ code: 'renderer/limit' });
    expect(shapesOf()).toEqual(BUFFERS);
    await first.reset();
    expect(await film(first)).toEqual(before);
    first.destroy();

    // The driver refuses the kernels that read textures, once.
    const { device: small, shapes, live } = limited(device);
    const tracer = await PathTracer.create(small, scene, options);
    let refusals = 0;
    const create = device.createComputePipelineAsync;
    device.createComputePipelineAsync = (of) => {
      if (!/intersect/.test(of.label ?? '') || refusals++ > 0) return create.call(device, of);
      return Promise.reject(new Error('refused for a test'));
    };
    try {
      await expect(tracer.replaceMesh(0, mesh)).rejects.toMatchObject({ code: 'renderer/gpu-error' });
    } finally {
      device.createComputePipelineAsync = create;
    }
    expect(refusals).toBeGreaterThan(0);
    expect(shapes()).toEqual(BUFFERS);
    expect(await film(tracer)).toEqual(before);
    await tracer.replaceMesh(0, mesh);
    expect(shapes()).toEqual(TEXTURES);
    expect(await film(tracer)).toEqual(await fresh(device, grown));
    tracer.destroy();
    expect([...live.values()]).toEqual([]);
  });
});

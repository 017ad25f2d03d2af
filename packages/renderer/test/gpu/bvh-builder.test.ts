import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Mesh, Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { COMPACT_SHAPES } from '../../src/geometry/compact-shapes';
import { prepareGeometry } from '../../src/geometry/prepare-geometry';
import { buildOnGpu } from '../../src/geometry/gpu-trees';
import { buildsOnGpu, gpuBuilds, suitsGpu, type GpuBuilds } from '../../src/geometry/hierarchy';
import { Placement } from '../../src/geometry/placement';
import { PathTracer, requestDevice, type PathTracerOptions } from '../../src/index';
import { createGpu } from '../../src/node';
import { GpuMemory } from '../../src/storage/buffers';
import { addBox, addQuad, addSphere, camera, createScene, lambert } from '../scenes';
import { losingDevice } from '../losing-device';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});
afterEach(() => expectNoGpuErrors());

const options: PathTracerOptions = { width: 24, height: 24, camera, pathsInFlight: 1 << 12, maxDepth: 4 };
const moved = (x: number, y: number, z: number) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1];

/** Shapes of more than a MiB are compact, such as those of a stage with a ball of as many segments. */
const COMPACT: PathTracerOptions = { ...options, bvhBuilder: 'gpu', memory: { compactAboveMiB: 1 } };
const COMPACT_SEGMENTS = 140;

/** A smooth ball, a box with texture coordinates of its own, a floor and a glowing square of many triangles. */
function stage(segments = 32): Scene {
  const scene = createScene();
  addQuad(scene, 0.9, -0.2, lambert(0.6, 0.5, 0.4));
  addSphere(scene, 0.3, [-0.3, 0, 0.2], { name: 'ball', parameters: { specular_roughness: 0.3 } }, segments);
  addBox(scene, [0.2, -0.2, 0], [0.5, 0.2, 0.4], { ...lambert(0.3, 0.4, 0.6), name: 'box' });
  addSphere(
    scene,
    0.1,
    [0.3, 0.6, 0.3],
    { name: 'light', parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 20 } },
    12,
  );
  for (const [i, name] of ['floor', 'ball', 'box', 'light'].entries())
    Object.assign(scene.instances[i] as object, { name });
  scene.environment = { type: 'constant', radiance: [0.3, 0.4, 0.5] };
  return scene;
}

async function beauty(tracer: PathTracer, samples = 8): Promise<Float32Array> {
  for await (const _ of tracer.render({ samples, maxSubmitMs: 1000 }));
  return tracer.read('beauty');
}

async function fresh(scene: Scene, bvhBuilder: 'cpu' | 'gpu', over: Partial<PathTracerOptions> = {}) {
  const tracer = await PathTracer.create(device, scene, { ...options, ...over, bvhBuilder });
  const pixels = await beauty(tracer);
  tracer.destroy();
  return pixels;
}

/** A device that counts live buffers, and some of whose members are replaced. */
function watched(members: (target: GPUDevice) => Readonly<Record<string, unknown>> = () => ({})) {
  const live = new Map<GPUBuffer, string>();
  const others = members(device);
  const make = (others['createBuffer'] ?? device.createBuffer.bind(device)) as GPUDevice['createBuffer'];
  const createBuffer = (descriptor: GPUBufferDescriptor) => {
    const buffer = make(descriptor);
    live.set(buffer, descriptor.label ?? '');
    const destroy = buffer.destroy.bind(buffer);
    buffer.destroy = () => {
      live.delete(buffer);
      return destroy();
    };
    return buffer;
  };
  const proxy = new Proxy(device, {
    get: (target, name) => {
      if (name === 'createBuffer') return createBuffer;
      if (typeof name === 'string' && name in others) return others[name];
      const value = Reflect.get(target, name) as unknown;
      return typeof value === 'function' ? (value as () => unknown).bind(target) : value;
    },
  });
  return { device: proxy, live };
}

describe('hierarchies built on the GPU', () => {
  it('give the image that those of the CPU give, bit for bit', async () => {
    const scene = stage();
    expect(await fresh(scene, 'gpu')).toEqual(await fresh(scene, 'cpu'));
  });

  it('are reported, and their temporary memory is freed', async () => {
    const scene = stage();
    const tracer = await PathTracer.create(device, scene, { ...options, bvhBuilder: 'gpu' });
    const { builds, memory, gpuBytes } = tracer.statistics;
    const triangles = scene.meshes.reduce((sum, { indices }) => sum + indices.length / 3, 0);
    expect(builds).toEqual([
      expect.objectContaining({ where: 'gpu', meshes: 4, triangles, ms: expect.any(Number) as number }),
    ]);
    const largest = Math.max(...scene.meshes.map(({ indices }) => indices.length / 3));
    expect(builds[0]?.temporaryBytes).toBeGreaterThan(200 * largest);
    const other = await PathTracer.create(device, scene, { ...options, bvhBuilder: 'cpu' });
    expect(other.statistics.builds).toEqual([expect.objectContaining({ where: 'cpu', meshes: 4, temporaryBytes: 0 })]);
    // The trees differ in their number of nodes alone.
    expect(memory.other).toBe(other.statistics.memory.other);
    expect(gpuBytes - memory.shapes).toBe(other.statistics.gpuBytes - other.statistics.memory.shapes);
    tracer.destroy();
    other.destroy();
  });

  it('leave no buffer behind, with compact shapes too', async () => {
    for (const given of [{ ...options, bvhBuilder: 'gpu' } as const, COMPACT]) {
      const made = new Set<string>();
      const { device: counted, live } = watched((target) => ({
        createBuffer: (descriptor: GPUBufferDescriptor) => {
          made.add(descriptor.label ?? '');
          return target.createBuffer(descriptor);
        },
      }));
      const tracer = await PathTracer.create(counted, stage(given === COMPACT ? COMPACT_SEGMENTS : 32), given);
      expect(made.has('glanz compact records')).toBe(given === COMPACT);
      expect([...live.values()].filter((label) => /bvh|build|compact records/.test(label))).toEqual([]);
      tracer.destroy();
      expect([...live.values()]).toEqual([]);
    }
  });

  it('are built over instances, too, and moved on the CPU', async () => {
    const { live, device: proxy } = watched();
    const labels = new Set<string>();
    const memory = new GpuMemory(proxy);
    const buffer = memory.buffer.bind(memory);
    memory.buffer = (label, ...rest) => (labels.add(label), buffer(label, ...rest));
    const scene = stage();
    const builds = { device: proxy, memory, minTriangles: Infinity, minInstances: 4 };
    const { placement, blas } = await prepareGeometry(scene, { gpu: builds });
    expect(labels).toEqual(new Set(['build boxes']));
    expect(live.size).toBe(0);
    const own = new Placement(scene, blas);
    expect(placement.tlas.bounds).toEqual(own.tlas.bounds);
    const before = placement.tlas.nodes.slice();
    scene.instances[2]!.transform = moved(0.1, 0, 0);
    for (const one of [placement, own]) one.update(scene, blas, [2], true);
    expect(placement.tlas.nodes).not.toEqual(before);
    expect(placement.tlas.bounds).toEqual(own.tlas.bounds);
    // Where there is no memory for the copy, it is built on the CPU.
    let starved = false;
    const { device: poor } = watched((target) => ({
      createBuffer: (descriptor: GPUBufferDescriptor) => {
        starved ||= descriptor.label === 'glanz read';
        return target.createBuffer(descriptor);
      },
      popErrorScope: async () => {
        const error = await target.popErrorScope();
        return starved ? { message: 'no memory' } : error;
      },
    }));
    const poorly = { ...builds, device: poor, memory: new GpuMemory(poor) };
    const { placement: onCpu } = await prepareGeometry(scene, { gpu: poorly });
    expect(starved).toBe(true);
    expect(onCpu.tlas.nodes).toEqual(new Placement(scene, blas).tlas.nodes);
    // With fewer instances, too.
    labels.clear();
    await prepareGeometry(scene, { gpu: { ...builds, minInstances: 5 } });
    expect(labels.size).toBe(0);
  });

  it('are there for picking', async () => {
    const scene = stage();
    const [gpu, cpu] = await Promise.all(
      (['gpu', 'cpu'] as const).map((bvhBuilder) => PathTracer.create(device, scene, { ...options, bvhBuilder })),
    );
    const seen = new Set<number | undefined>();
    for (let y = 0.5; y < 24; y++)
      for (let x = 0.5; x < 24; x++) {
        const expected = cpu?.pick(x, y);
        expect(gpu?.pick(x, y)).toEqual(expected);
        seen.add(expected?.instance);
      }
    expect(seen.size).toBe(5);
    gpu?.destroy();
    cpu?.destroy();
  });

  it('stay through edits that lay the scene out again, and those that replace meshes', async () => {
    const scene = stage();
    addSphere(scene, 0.2, [0, -0.5, 0.2], { ...lambert(0.9), name: 'late' }, 24);
    Object.assign(scene.instances[4] as object, { name: 'late', visible: false });
    const tracer = await PathTracer.create(device, scene, { ...options, bvhBuilder: 'gpu' });
    const expected = { ...scene, instances: scene.instances.map((instance) => ({ ...instance })) };
    const check = async () => expect(await beauty(tracer)).toEqual(await fresh(expected, 'cpu'));
    await tracer.setInstanceTransform('ball', moved(0.1, 0.1, 0));
    Object.assign(expected.instances[1] as object, { transform: moved(0.1, 0.1, 0) });
    await check();
    await tracer.setMaterial('ball', { emission_luminance: 2 });
    expected.materials = expected.materials.map((material) =>
      material.name === 'ball'
        ? { ...material, parameters: { ...material.parameters, emission_luminance: 2 } }
        : material,
    );
    await check();
    // A mesh that was not shown before.
    await tracer.setVisibility('late', true);
    Object.assign(expected.instances[4] as object, { visible: true });
    await check();
    expect(tracer.pick(12, 12)).toBeDefined();
    // Smaller ones fit the region, larger ones do not.
    for (const segments of [16, 40]) {
      const other = createScene();
      addSphere(other, 0.25, [-0.3, 0, 0.2], lambert(0.5), segments);
      await tracer.replaceMesh(1, other.meshes[0] as Mesh);
      expected.meshes = expected.meshes.map((mesh, i) => (i === 1 ? (other.meshes[0] as Mesh) : mesh));
      await check();
    }
    tracer.destroy();
  });

  it('end with the reason of the signal, and free what they have', async () => {
    for (const stop of [
      'glanz build positions',
      'glanz build indices',
      'bvh primitives',
      'bvh triangles',
      'bvh nodes',
      'glanz compact records',
      'glanz build boxes',
    ]) {
      const control = new AbortController();
      const reason = new Error(`stopped at ${stop}`);
      const { device: counted, live } = watched((target) => ({
        createBuffer: (descriptor: GPUBufferDescriptor) => {
          if (descriptor.label === stop) control.abort(reason);
          return target.createBuffer(descriptor);
        },
      }));
      const [scene, given] =
        stop === 'glanz compact records'
          ? [stage(COMPACT_SEGMENTS), COMPACT]
          : [stage(), { ...options, bvhBuilder: 'gpu' as const }];
      const making = PathTracer.create(counted, scene, { ...given, signal: control.signal });
      await expect(making).rejects.toBe(reason);
      // Builds under way are not waited for.
      await expect.poll(() => [...live.values()]).toEqual([]);
    }
  });

  it('are built on the CPU where the GPU cannot: no shader, no memory', async () => {
    const scene = stage();
    const without = {
      shaders: watched((target) => ({
        createComputePipelineAsync: (descriptor: GPUComputePipelineDescriptor) =>
          descriptor.label?.startsWith('bvh')
            ? Promise.reject(new Error('no compiler'))
            : target.createComputePipelineAsync(descriptor),
      })),
      memory: (() => {
        let starved = false;
        return watched((target) => ({
          createBuffer: (descriptor: GPUBufferDescriptor) => {
            if (descriptor.label === 'bvh primitives') starved = true;
            return target.createBuffer(descriptor);
          },
          popErrorScope: async () => {
            const error = await target.popErrorScope();
            if (!starved) return error;
            starved = false;
            return { message: 'no memory' };
          },
        }));
      })(),
    };
    const expected = await fresh(scene, 'cpu');
    for (const { device: poor, live } of Object.values(without)) {
      const tracer = await PathTracer.create(poor, scene, { ...options, bvhBuilder: 'gpu' });
      const { builds } = tracer.statistics;
      expect(builds.find(({ where }) => where === 'cpu')?.meshes).toBeGreaterThan(0);
      expect(builds.reduce((sum, { meshes }) => sum + meshes, 0)).toBe(4);
      expect(await beauty(tracer)).toEqual(expected);
      tracer.destroy();
      expect([...live.values()]).toEqual([]);
    }
  });

  it('are built on the CPU where the GPU refuses what writes compact shapes', async () => {
    const scene = stage(COMPACT_SEGMENTS);
    const expected = await fresh(scene, 'cpu', COMPACT);
    const refuse = (invalid: boolean) =>
      watched((target) => ({
        createShaderModule: (descriptor: GPUShaderModuleDescriptor) =>
          target.createShaderModule(
            invalid && descriptor.label === 'glanz compact records' ? { ...descriptor, code: 'fn main(' } : descriptor,
          ),
        createComputePipelineAsync: (descriptor: GPUComputePipelineDescriptor) =>
          descriptor.label === 'glanz compact records'
            ? Promise.reject(new Error('no compiler'))
            : target.createComputePipelineAsync(descriptor),
      }));
    for (const { device: poor, live } of [refuse(false), refuse(true)]) {
      const tracer = await PathTracer.create(poor, scene, COMPACT);
      expect(tracer.statistics.builds.map(({ where, meshes }) => [where, meshes])).toEqual([['cpu', 4]]);
      expect(await beauty(tracer)).toEqual(expected);
      tracer.destroy();
      expect([...live.values()]).toEqual([]);
    }
  });

  it('report a device that is lost while what writes compact shapes compiles', async () => {
    const { gpu } = await createGpu({ software: 'only' });
    const own = await requestDevice({ gpu });
    const losing = new Proxy(own, {
      get: (target, name) => {
        const value = Reflect.get(target, name) as unknown;
        if (name === 'createComputePipelineAsync')
          return (descriptor: GPUComputePipelineDescriptor) => {
            if (descriptor.label === 'glanz compact records') target.destroy();
            // The builder's programs fail as this one does.
            return target.lost.then(() => Promise.reject(new Error('lost')));
          };
        return typeof value === 'function' ? (value as () => unknown).bind(target) : value;
      },
    });
    const memory = new GpuMemory(losing);
    const compact = COMPACT_SHAPES;
    const making = buildOnGpu(gpuBuilds(losing, memory, 'gpu') as GpuBuilds, stage().meshes, {
      compact,
      signal: new AbortController().signal,
      onProgress: () => {},
    });
    await expect(making).rejects.toMatchObject({ code: 'renderer/device-lost' });
    expect(memory.bytes).toBe(0);
  });

  it('report a device that is lost while they are built', async () => {
    for (const stop of ['glanz build positions', 'bvh primitives', 'bvh read', 'glanz read']) {
      const losing = await losingDevice(stop);
      const memory = new GpuMemory(losing);
      const making = prepareGeometry(stage(), { gpu: gpuBuilds(losing, memory, 'gpu') });
      await expect(making, stop).rejects.toMatchObject({ code: 'renderer/device-lost' });
      expect(memory.bytes).toBe(0);
    }
    // The tree over instances is built from those of the meshes.
    const losing = await losingDevice('glanz build boxes', true);
    const making = PathTracer.create(losing, stage(), { ...options, bvhBuilder: 'gpu' });
    await expect(making).rejects.toMatchObject({ code: 'renderer/device-lost' });
  });

  it('are chosen by device and size', () => {
    const as = (info: object | undefined, limit = 2 ** 27) =>
      ({
        adapterInfo: info,
        limits: { maxStorageBufferBindingSize: limit, maxBufferSize: 2 ** 28 },
      }) as unknown as GPUDevice;
    const real = as({ architecture: 'hopper', device: '', description: 'a GPU' });
    const software = as({ architecture: 'swiftshader', device: '', description: '' });
    expect([real, software, as(undefined)].map((one) => buildsOnGpu(one))).toEqual([true, false, false]);
    expect(buildsOnGpu(real, 'cpu')).toBe(false);
    expect(buildsOnGpu(software, 'gpu')).toBe(true);
    const mesh = (triangles: number) => ({ indices: { length: 3 * triangles } }) as unknown as Mesh;
    const builds = { device: real, memory: new GpuMemory(real), minTriangles: 1000, minInstances: 1 };
    expect([999, 1000, 2 ** 21, 2 ** 21 + 1].map((count) => suitsGpu(builds, mesh(count)))).toEqual([
      false,
      true,
      true,
      false,
    ]);
  });

  it('are not built by default on a software adapter', async () => {
    const tracer = await PathTracer.create(device, stage(), options);
    expect(tracer.statistics.builds.map(({ where }) => where)).toEqual(['cpu']);
    tracer.destroy();
  });
});

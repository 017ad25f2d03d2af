import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Mesh, Scene } from '@glanz/scene';
import { createRig, poseMesh, type Pose } from '@glanz/scene/pose';
import { afterEach, beforeAll, expect, it, vi } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { poseOf, rigOf } from '../rigs';
import { addQuad, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});
afterEach(() => expectNoGpuErrors());

const options: PathTracerOptions = { width: 24, height: 24, camera, pathsInFlight: 1 << 12, maxDepth: 4 };
const rig = rigOf(16);
const POSES: readonly Pose[] = [poseOf(0), poseOf(0.3, [0.2]), poseOf(0.9, [0.5, 0.2])];

/** The rig before a wall, shown twice. */
function sceneOf(mesh: Mesh): Scene {
  const scene = createScene();
  addQuad(scene, 0.9, -0.4, lambert(0.6, 0.5, 0.4));
  scene.meshes.push(mesh);
  scene.materials.push({ name: 'body', parameters: { base_color: [0.4, 0.5, 0.7], specular_roughness: 0.3 } });
  for (const x of [-0.3, 0.35])
    scene.instances.push({
      name: `body ${x}`,
      mesh: 1,
      material: 1,
      transform: [0.8, 0, 0, 0, 0, 0.8, 0, 0, 0, 0, 0.8, 0, x, 0, 0, 1],
    });
  scene.environment = { type: 'constant', radiance: [0.8, 0.9, 1] };
  return scene;
}

async function beauty(tracer: PathTracer): Promise<Float32Array> {
  for await (const _ of tracer.render({ samples: 8, maxSubmitMs: 1000 }));
  return tracer.read('beauty');
}

async function fresh(mesh: Mesh): Promise<Float32Array> {
  const tracer = await PathTracer.create(device, sceneOf(mesh), { ...options, bvhBuilder: 'cpu' });
  const pixels = await beauty(tracer);
  tracer.destroy();
  return pixels;
}

/** The device, and how many poses it has been given. @param began Called with the label of all that it records. */
function counted(began: (label: string) => void = () => undefined) {
  const count = { poses: 0, builds: 0 };
  const proxy = new Proxy(device, {
    get(target, name) {
      if (name === 'createCommandEncoder')
        return (of: GPUCommandEncoderDescriptor) => {
          began(of.label ?? '');
          if (of.label === 'glanz pose') count.poses++;
          if (of.label === 'bvh keep') count.builds++;
          return target.createCommandEncoder(of);
        };
      const value = Reflect.get(target, name) as unknown;
      return typeof value === 'function' ? (value as () => unknown).bind(target) : value;
    },
  });
  return { device: proxy, count };
}

/** A ball whose neighbouring vertices have joints of their own, so that its hierarchy is of no use in some poses. */
function tornRig() {
  const { bind } = rigOf(12, { tangents: false });
  const vertices = bind.positions.length / 3;
  const joints = new Uint16Array(4 * vertices).map((_, i) => (i >> 2) % 2);
  const weights = new Float32Array(4 * vertices).map((_, i) => (i % 4 === 0 ? 1 : 0));
  return createRig(bind, { skin: { jointCount: 2, joints, weights } });
}

const moved = (x: number) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 0, 1];
const torn = (by: number): Pose => ({ joints: [...moved(0), ...moved(by)] });

/** Puts a tracer into poses, one after the other, and gives the image of the last. */
async function posed(bvhBuilder: 'cpu' | 'gpu', poses: readonly Pose[], on = device) {
  const tracer = await PathTracer.create(on, sceneOf(rig.bind), { ...options, bvhBuilder });
  for (const pose of poses) await tracer.replaceMesh('body', poseMesh(rig, pose));
  return { tracer, pixels: await beauty(tracer) };
}

/** Pixels that differ by more than rounding: rays that meet an edge choose another side of it. */
const differing = (a: Float32Array, b: Float32Array) =>
  a.reduce((sum, x, i) => sum + (i % 4 === 0 && Math.abs(x - b[i]!) > 1e-3 * Math.max(1, Math.abs(x)) ? 1 : 0), 0);

it('a pose on the GPU gives the image of a scene with the vertices of the CPU', async () => {
  const { device: watched, count } = counted();
  const { tracer, pixels } = await posed('gpu', POSES, watched);
  // The first pose replaces the mesh, and gives the hierarchy that is fitted to the others.
  expect(count.poses).toBe(2);
  const expected = await fresh({ ...poseMesh(rig, POSES[2]!) });
  expect(differing(pixels, expected)).toBeLessThanOrEqual(6);
  expect(differing(pixels, await fresh(rig.bind))).toBeGreaterThan(50);
  // The scene of the tracer is that of the pose, also for what the CPU looks up.
  const mesh = tracer.scene.meshes[1]!;
  expect(mesh.positions).toEqual(poseMesh(rig, POSES[2]!).positions);
  expect(tracer.pick(16, 12)?.instance).toBeGreaterThan(0);
  tracer.destroy();
});

it('poses again to the same bits, and follows edits of other parts', async () => {
  const { tracer, pixels } = await posed('gpu', POSES);
  await tracer.replaceMesh('body', poseMesh(rig, POSES[1]!));
  await tracer.setInstanceTransform('body 0.35', [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.4, 0, 0, 1]);
  await tracer.setInstanceTransform('body 0.35', sceneOf(rig.bind).instances[2]!.transform);
  await tracer.replaceMesh('body', poseMesh(rig, POSES[2]!));
  expect(await beauty(tracer)).toEqual(pixels);
  // A mesh that is laid out again takes the pose with it.
  const { positions, ...wall } = tracer.scene.meshes[0]!;
  const twice = { ...wall, positions, indices: Uint32Array.of(...wall.indices, ...wall.indices) };
  await tracer.replaceMesh(0, twice);
  await tracer.replaceMesh('body', poseMesh(rig, POSES[2]!));
  expect(differing(await beauty(tracer), pixels)).toBeLessThanOrEqual(6);
  tracer.destroy();
});

it('without builds on the GPU, the CPU computes the vertices', async () => {
  const { device: watched, count } = counted();
  const { tracer, pixels } = await posed('cpu', POSES, watched);
  expect(count.poses).toBe(0);
  expect(pixels).toEqual(await fresh({ ...poseMesh(rig, POSES[2]!) }));
  tracer.destroy();
});

it('a pose of another rig, or of none, replaces the mesh', async () => {
  const { tracer } = await posed('gpu', POSES);
  const other = rigOf(12);
  for (const pose of POSES) await tracer.replaceMesh('body', poseMesh(other, pose));
  const expected = await fresh({ ...poseMesh(other, POSES[2]!) });
  expect(differing(await beauty(tracer), expected)).toBeLessThanOrEqual(6);
  await tracer.replaceMesh('body', rig.bind);
  expect(await beauty(tracer)).toEqual(await fresh(rig.bind));
  tracer.destroy();
});

it('a posed mesh that was built on the GPU comes back after a pose on the GPU and another mesh', async () => {
  const { device: watched, count } = counted();
  const first = poseMesh(rig, POSES[1]!);
  const tracer = await PathTracer.create(watched, sceneOf(first), { ...options, bvhBuilder: 'gpu' });
  await tracer.replaceMesh('body', poseMesh(rig, POSES[2]!));
  expect(count.poses).toBe(1);
  await tracer.replaceMesh('body', rigOf(12).bind);
  await tracer.replaceMesh('body', first);
  expect(count.poses).toBe(1);
  const expected = await fresh({ ...first });
  expect(differing(await beauty(tracer), expected)).toBeLessThanOrEqual(6);
  await tracer.replaceMesh('body', poseMesh(rig, POSES[2]!));
  expect(count.poses).toBe(2);
  expect(differing(await beauty(tracer), await fresh({ ...poseMesh(rig, POSES[2]!) }))).toBeLessThanOrEqual(6);
  tracer.destroy();
});

it('and after a pose that its hierarchy is of no use for', async () => {
  const { device: watched, count } = counted();
  const ripped = tornRig();
  const first = poseMesh(ripped, torn(0));
  const tracer = await PathTracer.create(watched, sceneOf(first), { ...options, bvhBuilder: 'gpu' });
  const builds: number[] = [];
  for (const [pose, poses] of [
    [torn(4), 1],
    // Not on the GPU: it is built again, and then gives the hierarchy for those that follow.
    [undefined, 1],
    [torn(0.1), 2],
  ] as const) {
    const mesh = pose ? poseMesh(ripped, pose) : first;
    await tracer.replaceMesh('body', mesh);
    builds.push(count.builds);
    expect(count.poses).toBe(poses);
    expect(differing(await beauty(tracer), await fresh({ ...mesh }))).toBeLessThanOrEqual(6);
  }
  // The mesh, the wall and the tree over the instances, and the mesh again.
  expect(builds).toEqual([3, 4, 4]);
  tracer.destroy();
});

it('two poses of different rigs, not awaited, both end, and the image is of the second', async () => {
  const { tracer } = await posed('gpu', POSES);
  const other = rigOf(12);
  await Promise.all([
    tracer.replaceMesh('body', poseMesh(rig, POSES[1]!)),
    tracer.replaceMesh('body', poseMesh(other, POSES[2]!)),
  ]);
  const expected = await fresh({ ...poseMesh(other, POSES[2]!) });
  expect(differing(await beauty(tracer), expected)).toBeLessThanOrEqual(6);
  // A poser of a rig that is no longer shown keeps nothing.
  const bytes = async () => {
    await tracer.replaceMesh('body', rig.bind);
    return tracer.statistics.gpuBytes;
  };
  const before = await bytes();
  await tracer.replaceMesh('body', poseMesh(rig, POSES[1]!));
  await tracer.replaceMesh('body', poseMesh(rig, POSES[2]!));
  expect(tracer.statistics.gpuBytes).toBeGreaterThan(before);
  expect(await bytes()).toBe(before);
  tracer.destroy();
});

it('replacing a mesh computes no vertices of others that the GPU has posed', async () => {
  const { tracer } = await posed('gpu', POSES);
  const mesh = poseMesh(rig, POSES[1]!);
  const positions = vi.fn<() => Mesh['positions']>(() => mesh.positions);
  await tracer.replaceMesh(
    'body',
    Object.defineProperties({} as Mesh, {
      ...Object.getOwnPropertyDescriptors(mesh),
      positions: { enumerable: true, get: positions },
    }),
  );
  const { positions: corners, ...wall } = tracer.scene.meshes[0]!;
  await tracer.replaceMesh(0, { ...wall, positions: corners.map((x) => 0.9 * x) });
  expect(positions).not.toHaveBeenCalled();
  tracer.destroy();
});

it.each(['glanz read', 'bvh build', 'bvh read', 'glanz tree cost', 'glanz pose'])(
  'destroyed during "%s" of a pose, a tracer keeps no memory, and the edit ends',
  async (step) => {
    let tracer: PathTracer | undefined;
    let isDestroyed = false;
    const { device: watched } = counted((label) => {
      if (label !== step || !tracer) return;
      const { destroy } = tracer;
      tracer = undefined;
      queueMicrotask(() => {
        isDestroyed = true;
        destroy.call(made);
      });
    });
    const made = await PathTracer.create(watched, sceneOf(poseMesh(rig, POSES[1]!)), { ...options, bvhBuilder: 'gpu' });
    tracer = made;
    await made.replaceMesh('body', poseMesh(rig, POSES[2]!));
    expect(isDestroyed).toBe(true);
    expect(made.statistics.gpuBytes).toBe(0);
    await expect(made.replaceMesh('body', rig.bind)).rejects.toMatchObject({ code: 'renderer/destroyed' });
  },
);

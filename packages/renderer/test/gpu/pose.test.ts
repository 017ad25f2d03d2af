import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Mesh, Scene } from '@glanz/scene';
import { poseMesh, type Pose } from '@glanz/scene/pose';
import { afterEach, beforeAll, expect, it } from 'vitest';
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

/** The device, and how many poses it has been given. */
function counted() {
  const count = { poses: 0 };
  const proxy = new Proxy(device, {
    get(target, name) {
      if (name === 'createCommandEncoder')
        return (of: GPUCommandEncoderDescriptor) => {
          if (of.label === 'glanz pose') count.poses++;
          return target.createCommandEncoder(of);
        };
      const value = Reflect.get(target, name) as unknown;
      return typeof value === 'function' ? (value as () => unknown).bind(target) : value;
    },
  });
  return { device: proxy, count };
}

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

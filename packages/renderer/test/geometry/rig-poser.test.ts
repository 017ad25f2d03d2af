import { buildBlas } from '@glanz/bvh';
import { refitBlas } from '@glanz/bvh/refit';
import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Mesh, MeshPose, MeshRig } from '@glanz/scene';
import { createRig, poseMesh, type Pose } from '@glanz/scene/pose';
import { afterEach, expect, it } from 'vitest';
import { packPose } from '../../src/geometry/pose/rig-data';
import { RigPoser } from '../../src/geometry/pose/rig-poser';
import { GpuMemory } from '../../src/storage/buffers';
import { readBuffer } from '../../src/storage/read-buffer';
import { poseOf, rigOf } from '../rigs';
import { losingDevice } from '../losing-device';

afterEach(() => expectNoGpuErrors());

/** Poses a rig on the GPU, at places that are not the first of the arrays. */
async function posed(rig: MeshRig, poses: readonly Pose[]) {
  const device = await testDevice({ defaultLimits: true, features: [] });
  const memory = new GpuMemory(device);
  const { bind } = rig;
  const base = buildBlas(bind);
  const poser = await RigPoser.create({ device, memory, minTriangles: 1, minInstances: 1 }, rig, base);
  const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST | GPUBufferUsage.COPY_SRC;
  const words = bind.positions.length + (bind.tangents?.length ?? 0);
  const stored = base.triangleIndices.length;
  const arrays = {
    nodes: memory.buffer('nodes', 64 * (3 + base.nodeCount), usage),
    triangles: memory.buffer('triangles', 48 * (5 + stored), usage),
    attributes: memory.buffer('attributes', 4 * (7 + bind.indices.length + words), usage),
  };
  const region = {
    firstNode: 3,
    nodes: base.nodeCount,
    firstTriangle: 5,
    triangles: stored,
    firstVertex: 0,
    vertices: 0,
    firstWord: 7,
    words: bind.indices.length + words,
  };
  const results = [];
  for (const pose of poses) {
    const mesh = poseMesh(rig, pose);
    const packed = packPose(mesh.pose as MeshPose);
    if (!packed) throw new Error('the pose is not finite');
    poser.run(packed, (name) => arrays[name], region);
    const triangles = new Float32Array(await readBuffer(device, arrays.triangles, 48 * stored, 48 * 5));
    const shading = new Float32Array(
      await readBuffer(device, arrays.attributes, 4 * words, 4 * (7 + bind.indices.length)),
    );
    const nodes = new Float32Array(await readBuffer(device, arrays.nodes, 64 * base.nodeCount, 64 * 3));
    // Positions by vertex.
    const positions = new Float32Array(bind.positions.length);
    base.triangleIndices.forEach((triangle, leaf) => {
      for (let corner = 0; corner < 3; corner++)
        positions.set(
          triangles.subarray(12 * leaf + 4 * corner, 12 * leaf + 4 * corner + 3),
          3 * (bind.indices[3 * triangle + corner] as number),
        );
    });
    const { length } = bind.normals ?? [];
    results.push({
      mesh,
      positions,
      normals: shading.subarray(0, length),
      tangents: shading.subarray(length),
      nodes,
      bounds: poser.boundsOf(mesh.pose as MeshPose),
    });
  }
  poser.destroy();
  for (const buffer of Object.values(arrays)) memory.release(buffer);
  expect(memory.bytes).toBe(0);
  return { results, base };
}

const at = (x: number) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 0, 1];

const farthest = (a: Float32Array, b: Float32Array | undefined, isUsed: (i: number) => boolean = () => true) =>
  a.reduce((max, x, i) => (isUsed(i) ? Math.max(max, Math.abs(x - (b?.[i] as number))) : max), 0);

const used = ({ indices }: Mesh) => {
  const set = new Set(indices);
  return (i: number) => set.has(Math.floor(i / 3));
};

it.each([
  ['skin, targets, normals and tangents', rigOf(), [poseOf(0), poseOf(0.8, [0.5, -0.4]), poseOf(-2, [0, 1], true)]],
  ['skin and normals', rigOf(24, { tangents: false }), [poseOf(0.8, [1])]],
  ['targets alone', rigOf(24, { joints: false }), [{ weights: [0.7, -0.2] }, {}]],
] as const)('%s: vertices are those of the CPU within 16 units in the last place', async (_, rig, poses) => {
  const { results, base } = await posed(rig, poses);
  for (const { mesh, positions, normals, tangents, nodes, bounds } of results) {
    // Of the largest coordinate, near 1; directions are of length 1.
    const ulp = 2 ** -24;
    expect(farthest(positions, mesh.positions, used(mesh))).toBeLessThanOrEqual(16 * ulp);
    expect(farthest(normals, mesh.normals)).toBeLessThanOrEqual(16 * ulp);
    if (mesh.tangents) expect(farthest(tangents, mesh.tangents)).toBeLessThanOrEqual(16 * ulp);
    // Boxes are exactly those of the vertices on the GPU.
    const fitted = { ...base, nodes: base.nodes.slice() };
    refitBlas(fitted, { positions, indices: mesh.indices });
    expect(nodes.subarray(0, 16 * base.nodeCount)).toEqual(fitted.nodes.subarray(0, 16 * base.nodeCount));
    // Bounds are not smaller, and not much larger than a half more.
    for (let k = 0; k < 3; k++) {
      const [min, max] = [fitted.bounds.min[k]!, fitted.bounds.max[k]!];
      expect(bounds.min[k]).toBeLessThanOrEqual(min);
      expect(bounds.max[k]).toBeGreaterThanOrEqual(max);
      expect(bounds.max[k]! - bounds.min[k]!).toBeLessThan(2.5 * (max - min));
    }
  }
});

it('gives the same bits each time', async () => {
  const poses = [poseOf(0.8, [0.5, -0.4]), poseOf(-1), poseOf(0.8, [0.5, -0.4])];
  const { results } = await posed(rigOf(), poses);
  const [first, , again] = results.map(({ positions, normals, tangents, nodes }) => ({
    positions,
    normals,
    tangents,
    nodes,
  }));
  expect(again).toEqual(first);
});

it('reports that its hierarchy needs a rebuild where neighbours are moved apart', async () => {
  const device = await testDevice({ defaultLimits: true, features: [] });
  const memory = new GpuMemory(device);
  const { bind } = rigOf(12, { tangents: false });
  const vertices = bind.positions.length / 3;
  const joints = new Uint16Array(4 * vertices).map((_, i) => (i >> 2) % 2);
  const weights = new Float32Array(4 * vertices).map((_, i) => (i % 4 === 0 ? 1 : 0));
  const rig = createRig(bind, { skin: { jointCount: 2, joints, weights } });
  const usage = GPUBufferUsage.COPY_DST;
  const array = memory.buffer('array', 1 << 20, usage);
  const base = buildBlas(bind);
  const region = {
    firstNode: 0,
    nodes: 0,
    firstTriangle: 0,
    triangles: 0,
    firstVertex: 0,
    vertices: 0,
    firstWord: 0,
    words: 0,
  };
  for (const [by, needsRebuild] of [
    [0, false],
    [4, true],
  ] as const) {
    const poser = await RigPoser.create({ device, memory, minTriangles: 1, minInstances: 1 }, rig, base);
    const pose = poseMesh(rig, { joints: [...at(0), ...at(by)] }).pose as MeshPose;
    poser.run(packPose(pose)!, () => array, region);
    await poser.measured;
    expect(poser.needsRebuild).toBe(needsRebuild);
    poser.destroy();
  }
  memory.release(array);
});

it('poses whose matrices single precision cannot hold are left to the CPU', () => {
  const rig = rigOf(8);
  const { joints } = poseOf(1);
  const pose = { joints: Array.from(joints as number[], (x) => 1e39 * x) };
  expect(packPose(poseMesh(rig, pose).pose as MeshPose)).toBeUndefined();
});

it.each(['glanz pose bind', 'glanz pose cost read'])(
  'reports a device that is lost at "%s", and keeps no memory',
  async (label) => {
    const losing = await losingDevice(label);
    const memory = new GpuMemory(losing);
    const rig = rigOf(8);
    const making = RigPoser.create(
      { device: losing, memory, minTriangles: 1, minInstances: 1 },
      rig,
      buildBlas(rig.bind),
    );
    await expect(making).rejects.toMatchObject({ code: 'renderer/device-lost' });
    expect(memory.bytes).toBe(0);
  },
);

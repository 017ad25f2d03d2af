import { buildBlas } from '@glanz/bvh';
import { createScene, type Mesh, type Scene } from '@glanz/scene';
import { describe, expect, test } from 'vitest';
import { chooseCompact } from '../../src/geometry/choose-compact';
import { joinSlices, layOutGeometry, packGeometry, shapeSlices } from '../../src/geometry/geometry';
import type { ShapeSlice } from '../../src/storage/shape-arrays';
import { addSphere } from '../scenes';

const grey = { name: 'grey', parameters: {} };

/** The same bytes: the matchers take seconds for so many numbers. */
const same = (actual: ArrayBufferView, expected: ArrayBufferView) =>
  expect(Buffer.compare(bytes(actual), bytes(expected))).toBe(0);
const bytes = ({ buffer, byteOffset, byteLength }: ArrayBufferView) =>
  Buffer.from(buffer as ArrayBuffer, byteOffset, byteLength);

test('slices of shapes are small, do not overlap and hold every triangle and attribute where its region says', async () => {
  const scene = createScene('slices');
  addSphere(scene, 1, [0, 0, 0], grey, 240);
  addSphere(scene, 0.5, [2, 0, 0], grey, 12);
  const blas = scene.meshes.map(({ positions, indices }) => buildBlas({ positions, indices }));
  const geometry = layOutGeometry(scene, blas);
  const sizes = {
    nodes: 64 * geometry.nodeCount,
    triangles: 48 * geometry.triangleCount,
    attributes: 4 * geometry.attributeWords,
  };
  const written = {
    nodes: new Uint8Array(sizes.nodes),
    triangles: new Uint8Array(sizes.triangles),
    attributes: new Uint8Array(sizes.attributes),
  };
  let slices = 0;
  for (const { buffer, offset, data } of shapeSlices(scene, geometry)) {
    slices++;
    expect(data.byteLength).toBeLessThanOrEqual(1 << 21);
    const part = written[buffer].subarray(offset, offset + data.byteLength);
    expect(part.length).toBe(data.byteLength);
    expect(part.every((times) => times === 0)).toBe(true);
    part.fill(1);
  }
  expect(slices).toBeGreaterThan(8);
  for (const name of ['triangles', 'attributes'] as const)
    expect(written[name].every((times) => times === 1)).toBe(true);

  const memory = {
    nodes: new Uint8Array(sizes.nodes),
    triangles: new Uint8Array(sizes.triangles),
    attributes: new Uint8Array(sizes.attributes),
  };
  for (const { buffer, offset, data } of await packGeometry(scene, geometry))
    memory[buffer].set(new Uint8Array(data.buffer, data.byteOffset, data.byteLength), offset);
  const [nodes, triangles] = [new Float32Array(memory.nodes.buffer), new Float32Array(memory.triangles.buffer)];
  const { attributes } = memory;
  const ids = new Uint32Array(triangles.buffer);
  scene.meshes.forEach((mesh, index) => {
    const region = geometry.regions[index]!,
      tree = blas[index]!;
    same(nodes.subarray(16 * region.firstNode, 16 * (region.firstNode + region.nodes)), tree.nodes);
    const words = new Uint32Array(attributes.buffer);
    same(words.subarray(region.firstWord, region.firstWord + mesh.indices.length), mesh.indices);
    const normals = mesh.normals!;
    same(new Float32Array(attributes.buffer, 4 * (region.firstWord + mesh.indices.length), normals.length), normals);
    for (let i = 0; i < region.triangles; i++) {
      const triangle = tree.triangleIndices[i]!,
        at = 12 * (region.firstTriangle + i);
      if (ids[at + 3] !== triangle) throw new Error(`stored triangle ${i} is ${ids[at + 3]}, not ${triangle}`);
      const vertex = 3 * mesh.indices[3 * triangle + 2]!;
      for (let k = 0; k < 3; k++)
        if (triangles[at + 8 + k] !== mesh.positions[vertex + k])
          throw new Error(`stored triangle ${i} has another third vertex`);
    }
  });
});

test('joined slices write the same bytes to the same places, in far fewer pieces where meshes are small', () => {
  const scene = createScene('joined');
  for (let i = 0; i < 40; i++) addSphere(scene, 0.1, [i, 0, 0], grey, 8 + 2 * (i % 4));
  addSphere(scene, 1, [0, 2, 0], grey, 200);
  // An unused mesh between the others takes no words of the buffer.
  scene.instances.splice(20, 1);
  const blas = scene.meshes.map(({ positions, indices }, i) =>
    i === 20 ? undefined : buildBlas({ positions, indices }),
  );
  const geometry = layOutGeometry(scene, blas);
  const sizes = {
    nodes: 64 * geometry.nodeCount,
    triangles: 48 * geometry.triangleCount,
    attributes: 4 * geometry.attributeWords,
  };
  const write = (slices: Iterable<ShapeSlice>) => {
    const memory = {
      nodes: new Uint8Array(sizes.nodes).fill(7),
      triangles: new Uint8Array(sizes.triangles).fill(7),
      attributes: new Uint8Array(sizes.attributes).fill(7),
    };
    let count = 0;
    for (const { buffer, offset, data } of slices) {
      count++;
      memory[buffer].set(new Uint8Array(data.buffer, data.byteOffset, data.byteLength), offset);
    }
    return { memory, count };
  };
  const single = write(shapeSlices(scene, geometry));
  const joined = write(joinSlices(shapeSlices(scene, geometry)));
  for (const name of ['nodes', 'triangles', 'attributes'] as const) same(joined.memory[name], single.memory[name]);
  expect(single.count).toBeGreaterThan(4 * 40);
  expect(joined.count).toBeLessThan(40);
});

describe('compact shapes are chosen', () => {
  /** Only the lengths of arrays decide. */
  const meshOf = (triangles: number, vertices: number, more: Partial<Record<keyof Mesh, unknown>> = {}) =>
    ({ name: 'mesh', positions: { length: 3 * vertices }, indices: { length: 3 * triangles }, ...more }) as Mesh;
  const sceneOf = (...meshes: Mesh[]): Scene => ({ ...createScene('large'), meshes });
  const large = meshOf(3e6, 1.5e6);

  test('above 256 MiB', async () => {
    expect(await chooseCompact(sceneOf(large))).toBeDefined();
    expect(await chooseCompact(sceneOf(meshOf(2e6, 1e6)))).toBeUndefined();
    expect(await chooseCompact(sceneOf(meshOf(2e6, 1e6)), { compactAboveMiB: 100 })).toBeDefined();
  });

  test('not for triangles without common vertices, which would take more', async () => {
    expect(await chooseCompact(sceneOf(meshOf(3e6, 9e6)))).toBeUndefined();
    expect(await chooseCompact(sceneOf(meshOf(3e6, 9e6)), { compactAboveMiB: 1 })).toBeUndefined();
    // With normals, which get smaller, they take three quarters.
    expect(await chooseCompact(sceneOf(meshOf(3e6, 9e6, { normals: { length: 27e6 } })))).toBeDefined();
  });

  test('not for many meshes that have their vertices in one array, of which each would have a copy', async () => {
    const parts = Array.from({ length: 100 }, () => meshOf(3e4, 1.5e6, { positions: large.positions }));
    expect(await chooseCompact(sceneOf(...parts))).toBeUndefined();
    // One more such part is no reason.
    expect(await chooseCompact(sceneOf(large, parts[0]!))).toBeDefined();
  });

  test('not where meshes have poses, unless their size is given', async () => {
    const posed = sceneOf(large, meshOf(100, 50, { pose: {} }));
    expect(await chooseCompact(posed)).toBeUndefined();
    expect(await chooseCompact(posed, { budgetMiB: 100 })).toBeUndefined();
    expect(await chooseCompact(posed, { compactAboveMiB: 256 })).toBeDefined();
  });
});

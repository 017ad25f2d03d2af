import { KHRMeshQuantization } from '@gltf-transform/extensions';
import { validateScene } from '@glanz/scene';
import { describe, expect, test } from 'vitest';
import { loadGltf } from '../src/index';
import { glb, spoiled, start, triangle, write } from './build';

const QUAD = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0]);

async function primitive(
  make: (t: ReturnType<typeof start>, p: ReturnType<ReturnType<typeof start>['document']['createPrimitive']>) => void,
) {
  const t = start();
  const p = t.document.createPrimitive();
  make(t, p);
  t.scene.addChild(t.document.createNode('part').setMesh(t.document.createMesh('mesh').addPrimitive(p)));
  const scene = await loadGltf(await write(t.document, [KHRMeshQuantization]));
  expect(validateScene(scene).filter(({ code }) => code !== 'scene/degenerate')).toEqual([]);
  return scene;
}

describe('indices', () => {
  test.each([
    ['8 bits', Uint8Array],
    ['16 bits', Uint16Array],
    ['32 bits', Uint32Array],
  ] as const)('of %s', async (_, Type) => {
    const { meshes } = await primitive((t, p) =>
      p
        .setAttribute('POSITION', t.accessor('VEC3', QUAD))
        .setIndices(t.accessor('SCALAR', new Type([0, 1, 2, 2, 1, 3]))),
    );
    expect(Array.from(meshes[0]!.indices)).toEqual([0, 1, 2, 2, 1, 3]);
    expect(meshes[0]!.indices).toBeInstanceOf(Uint32Array);
  });

  test('none: vertices in their order, what is left over dropped', async () => {
    const { meshes } = await primitive((t, p) => p.setAttribute('POSITION', t.accessor('VEC3', QUAD)));
    expect(Array.from(meshes[0]!.indices)).toEqual([0, 1, 2]);
  });
});

describe('modes', () => {
  test('a strip keeps the orientation of every triangle', async () => {
    const {
      meshes: [mesh],
    } = await primitive((t, p) => p.setMode(5).setAttribute('POSITION', t.accessor('VEC3', QUAD)));
    expect(mesh!.indices.length).toBe(6);
    // Counter-clockwise from +z: each triangle's normal must point there.
    for (let i = 0; i < 6; i += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => 3 * mesh!.indices[i + k]!) as [number, number, number];
      const P = mesh!.positions;
      expect((P[b]! - P[a]!) * (P[c + 1]! - P[a + 1]!) - (P[b + 1]! - P[a + 1]!) * (P[c]! - P[a]!)).toBe(1);
    }
  });

  test('a fan turns around its first vertex', async () => {
    const { meshes } = await primitive((t, p) =>
      p
        .setMode(6)
        .setAttribute('POSITION', t.accessor('VEC3', QUAD))
        .setIndices(t.accessor('SCALAR', new Uint16Array([0, 1, 3, 2]))),
    );
    expect(Array.from(meshes[0]!.indices)).toEqual([1, 3, 0, 3, 2, 0]);
  });

  test('points and lines are left out with a warning', async () => {
    const t = start();
    const mesh = t.document.createMesh('mixed');
    for (const mode of [0, 1, 2, 3, 4] as const)
      mesh.addPrimitive(t.document.createPrimitive().setMode(mode).setAttribute('POSITION', t.accessor('VEC3', QUAD)));
    t.scene.addChild(t.document.createNode().setMesh(mesh));
    const scene = await loadGltf(await write(t.document));
    expect(scene.meshes.length).toBe(1);
    expect(scene.warnings.map(({ code, path }) => [code, path])).toEqual(
      [0, 1, 2, 3].map((i) => ['gltf/primitive', `/meshes/0/primitives/${i}`]),
    );
  });
});

describe('attributes', () => {
  test('quantised positions are whole numbers, normalised ones fractions', async () => {
    const raw = new Int16Array([0, 0, 0, 32767, 0, 0, 0, -32767, 0, 0, 0, 100]);
    const plain = await primitive((t, p) => {
      t.document.createExtension(KHRMeshQuantization).setRequired(true);
      p.setAttribute('POSITION', t.accessor('VEC3', raw));
    });
    expect(Array.from(plain.meshes[0]!.positions.subarray(3, 9))).toEqual([32767, 0, 0, 0, -32767, 0]);
    const normalised = await primitive((t, p) => {
      t.document.createExtension(KHRMeshQuantization).setRequired(true);
      p.setAttribute('POSITION', t.accessor('VEC3', raw, true));
    });
    expect(Array.from(normalised.meshes[0]!.positions.subarray(3, 9))).toEqual([1, 0, 0, 0, -1, 0]);
  });

  test('normals have length 1; one without length is made from its triangles', async () => {
    const scene = await primitive((t, p) =>
      p
        .setAttribute('POSITION', t.accessor('VEC3', QUAD))
        .setAttribute('NORMAL', t.accessor('VEC3', new Float32Array([0, 0, 2, 0, 3, 4, 0, 0, 0, 0, 0, 1]))),
    );
    const normals = Array.from(scene.meshes[0]!.normals!);
    [0, 0, 1, 0, 0.6, 0.8, 0, 0, 1, 0, 0, 1].forEach((n, i) => expect(normals[i]).toBeCloseTo(n, 6));
    expect(scene.warnings.map(({ message }) => message)).toEqual([
      'mesh: 1 normals have length 0; they are computed from the triangles.',
    ]);
  });

  test('triangles whose normals all point to their backs are reversed, with a warning; one that agrees keeps them all', async () => {
    const facing = (z: readonly number[]) => new Float32Array(z.flatMap((value) => [0, 0, value]));
    const load = (z: readonly number[]) =>
      primitive((t, p) =>
        p
          .setAttribute('POSITION', t.accessor('VEC3', QUAD))
          .setAttribute('NORMAL', t.accessor('VEC3', facing(z)))
          .setIndices(t.accessor('SCALAR', new Uint16Array([0, 1, 2, 2, 1, 3]))),
      );
    const turned = await load([-1, -1, -1, -1]);
    // Clockwise from +z, so that the front is where the normals point.
    const { positions, indices } = turned.meshes[0]!;
    for (let i = 0; i < 6; i += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => 3 * indices[i + k]!) as [number, number, number];
      expect(
        (positions[b]! - positions[a]!) * (positions[c + 1]! - positions[a + 1]!) -
          (positions[b + 1]! - positions[a + 1]!) * (positions[c]! - positions[a]!),
      ).toBe(-1);
    }
    expect(turned.warnings).toEqual([
      expect.objectContaining({ code: 'gltf/primitive', message: expect.stringContaining('reversed') }),
    ]);
    // The second triangle agrees: corners 1, 2 and 3.
    for (const z of [
      [1, 1, 1, 1],
      [-1, 1, -1, 1],
    ]) {
      const kept = await load(z);
      expect(Array.from(kept.meshes[0]!.indices)).toEqual([0, 1, 2, 2, 1, 3]);
      expect(kept.warnings).toEqual([]);
    }
  });

  test('without normals a mesh stays flat, and its tangents count for nothing', async () => {
    const { meshes } = await primitive((t, p) =>
      p
        .setAttribute('POSITION', t.accessor('VEC3', QUAD))
        .setAttribute('TANGENT', t.accessor('VEC4', new Float32Array(16).fill(1))),
    );
    expect(meshes[0]!.normals).toBeUndefined();
    expect(meshes[0]!.tangents).toBeUndefined();
  });

  test('both UV sets, also the second alone and normalised; colours with and without alpha', async () => {
    const {
      meshes: [mesh],
    } = await primitive((t, p) =>
      p
        .setAttribute('POSITION', t.accessor('VEC3', QUAD))
        .setAttribute('TEXCOORD_1', t.accessor('VEC2', new Uint8Array([0, 255, 51, 102, 0, 0, 255, 255]), true))
        .setAttribute('COLOR_0', t.accessor('VEC3', new Float32Array([1, 0, 0.5, 2, -1, 0, 0, 0, 0, 1, 1, 1]))),
    );
    expect(mesh!.uvs!.length).toBe(2);
    expect(Array.from(mesh!.uvs![1]!)).toEqual([0, 1, 0.2, 0.4, 0, 0, 1, 1].map(Math.fround));
    expect(Array.from(mesh!.colors!.subarray(0, 8))).toEqual([1, 0, 0.5, 1, 1, 0, 0, 1]);
  });

  test('an attribute of a wrong length is left out with a warning', async () => {
    const scene = await primitive((t, p) =>
      p
        .setAttribute('POSITION', t.accessor('VEC3', QUAD))
        .setAttribute('TEXCOORD_0', t.accessor('VEC2', new Float32Array(6))),
    );
    expect(scene.meshes[0]!.uvs).toBeUndefined();
    expect(scene.warnings[0]!.message).toMatch(/TEXCOORD_0 has 3 entries for 4 vertices/);
  });

  test('interleaved views', async () => {
    const binary = new Uint8Array(6 * 4 * 3);
    const floats = new Float32Array(binary.buffer);
    [
      [0, 0, 0],
      [2, 0, 0],
      [0, 3, 0],
    ].forEach((p, i) => floats.set([...p, 0, 0, 1], 6 * i));
    const { json } = triangle();
    json['buffers'] = [{ byteLength: 72 }];
    json['bufferViews'] = [{ buffer: 0, byteLength: 72, byteStride: 24 }];
    json['accessors'] = [0, 12].map((byteOffset) => ({
      bufferView: 0,
      byteOffset,
      componentType: 5126,
      type: 'VEC3',
      count: 3,
    }));
    json['meshes'][0].primitives[0] = { attributes: { POSITION: 0, NORMAL: 1 } };
    const {
      meshes: [mesh],
    } = await loadGltf(glb(json, binary));
    expect(Array.from(mesh!.positions)).toEqual([0, 0, 0, 2, 0, 0, 0, 3, 0]);
    expect(Array.from(mesh!.normals!)).toEqual([0, 0, 1, 0, 0, 1, 0, 0, 1]);
  });

  test('sparse values replace those of the view', async () => {
    const { json, binary } = triangle();
    const bytes = new Uint8Array(60);
    bytes.set(binary);
    new Uint16Array(bytes.buffer, 44, 1)[0] = 2;
    new Float32Array(bytes.buffer, 48, 3).set([5, 6, 7]);
    json['buffers'][0].byteLength = 60;
    json['bufferViews'].push(
      { buffer: 0, byteOffset: 44, byteLength: 2 },
      { buffer: 0, byteOffset: 48, byteLength: 12 },
    );
    json['accessors'][0].sparse = {
      count: 1,
      indices: { bufferView: 2, componentType: 5123 },
      values: { bufferView: 3 },
    };
    const { meshes } = await loadGltf(glb(json, bytes));
    expect(Array.from(meshes[0]!.positions)).toEqual([0, 0, 0, 1, 0, 0, 5, 6, 7]);
  });

  test('positions that are not finite cost their triangles, and no NaN comes out', async () => {
    const scene = await primitive((t, p) =>
      p
        .setAttribute('POSITION', t.accessor('VEC3', new Float32Array([...QUAD, NaN, 0, 0])))
        .setIndices(t.accessor('SCALAR', new Uint16Array([0, 1, 2, 0, 1, 4]))),
    );
    expect(Array.from(scene.meshes[0]!.indices)).toEqual([0, 1, 2]);
    expect(scene.meshes[0]!.positions.every(Number.isFinite)).toBe(true);
    expect(scene.warnings[0]!.message).toMatch(/1 triangles have corners/);
  });
});

test('the triangle that other tests spoil is sound', async () => {
  const scene = await loadGltf(spoiled(() => undefined));
  expect(scene.warnings).toEqual([]);
  expect(Array.from(scene.meshes[0]!.positions)).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0]);
});

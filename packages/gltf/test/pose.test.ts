import { expect, test } from 'vitest';
import { loadGltf } from '../src/index';
import { glb, type TriangleJson } from './build';

interface Skinned {
  /** Four of each vertex. */
  readonly joints?: readonly number[];
  readonly weights?: readonly number[];
  readonly change?: (json: TriangleJson) => void;
}

/**
 * A triangle at (0, 0, 0), (1, 0, 0), (0, 1, 0) that two joints move: the first by 10 along x, the second by 10 along
 * y.
 */
function skinned({
  joints = [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
  weights = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0],
  change = () => undefined,
}: Skinned): Uint8Array<ArrayBuffer> {
  const binary = new Uint8Array(36 + 12 + 48);
  new Float32Array(binary.buffer, 0, 9).set([0, 0, 0, 1, 0, 0, 0, 1, 0]);
  binary.set(joints, 36);
  new Float32Array(binary.buffer, 48, 12).set(weights);
  const json: TriangleJson = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0, 1, 2] }],
    nodes: [{ mesh: 0, skin: 0, translation: [0, 0, 50] }, { translation: [10, 0, 0] }, { translation: [0, 10, 0] }],
    skins: [{ joints: [1, 2] }],
    meshes: [{ name: 'body', primitives: [{ attributes: { POSITION: 0, JOINTS_0: 1, WEIGHTS_0: 2 } }] }],
    buffers: [{ byteLength: binary.length }],
    bufferViews: [
      { buffer: 0, byteLength: 36 },
      { buffer: 0, byteOffset: 36, byteLength: 12 },
      { buffer: 0, byteOffset: 48, byteLength: 48 },
    ],
    accessors: [
      { bufferView: 0, componentType: 5126, type: 'VEC3', count: 3 },
      { bufferView: 1, componentType: 5121, type: 'VEC4', count: 3 },
      { bufferView: 2, componentType: 5126, type: 'VEC4', count: 3 },
    ],
  };
  change(json);
  return glb(json, binary);
}

const load = async (parts: Skinned) => {
  const { warnings, meshes, instances } = await loadGltf(skinned(parts));
  return {
    warnings: warnings.map(({ message }) => message),
    positions: [...meshes[0]!.positions],
    transform: instances[0]!.transform,
  };
};

test('joints and weights that make sense bring no warning', async () => {
  const { warnings, positions } = await load({
    joints: [0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0],
    weights: [0.5, 0.5, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0],
  });
  expect(warnings).toEqual([]);
  expect(positions).toEqual([5, 5, 0, 1, 10, 0, 10, 1, 0]);
});

test('joints that do not exist are ignored, and reported', async () => {
  const { warnings, positions } = await load({
    joints: [2, 0, 0, 0, 1, 255, 0, 0, 0, 0, 0, 0],
    weights: [1, 0, 0, 0, 0.5, 0.5, 0, 0, 1, 0, 0, 0],
  });
  expect(warnings).toEqual([
    'body: JOINTS_0 names a joint that does not exist 2 times (the skin has 2); it is ignored.',
  ]);
  expect(positions).toEqual([0, 0, 0, 1, 10, 0, 10, 1, 0]);
});

test.each([
  ['negative', [1, -1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0], /WEIGHTS_0 holds 1 negative numbers/],
  ['not finite', [1, NaN, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0], /WEIGHTS_0 holds numbers that are not finite/],
  ['too large', [8, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0], /weights of 1 vertices do not add up to 1; they are scaled/],
] as const)('weights that are %s', async (_, weights, message) => {
  const { warnings, positions } = await load({ weights });
  expect(warnings).toEqual([expect.stringMatching(message)]);
  expect(positions).toEqual([10, 0, 0, 11, 0, 0, 10, 1, 0]);
});

test('a vertex without weights stays where it is', async () => {
  const { warnings, positions } = await load({ weights: [0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0] });
  expect(warnings).toEqual([expect.stringMatching(/weights of 1 vertices/)]);
  expect(positions.slice(0, 3)).toEqual([0, 0, 0]);
});

test('as many joints as weights as vertices', async () => {
  const { warnings } = await load({ change: (json) => void (json['accessors'][1].count = 2) });
  expect(warnings).toEqual(['body: JOINTS_0 and WEIGHTS_0 have 2 and 3 entries for 3 vertices and are ignored.']);
});

test('a mesh that a skin cannot move stands at its node', async () => {
  const { warnings, positions, transform } = await load({
    change: (json) => void (json['meshes'][0].primitives[0].attributes = { POSITION: 0 }),
  });
  expect(warnings).toEqual([
    expect.stringMatching(/\/nodes\/0\/skin poses mesh 0, which has a primitive without JOINTS_0/),
  ]);
  expect(positions).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0]);
  expect(Array.from(transform).slice(12, 15)).toEqual([0, 0, 50]);
});

test('a later set of joints without its weights is reported', async () => {
  const { warnings } = await load({ change: (json) => void (json['meshes'][0].primitives[0].attributes.JOINTS_1 = 1) });
  expect(warnings).toEqual([expect.stringMatching(/has JOINTS_1 without WEIGHTS_1/)]);
});

test('a later set of another type is left out', async () => {
  const { warnings } = await load({
    change: (json) => Object.assign(json['meshes'][0].primitives[0].attributes, { JOINTS_1: 1, WEIGHTS_1: 0 }),
  });
  expect(warnings).toEqual([
    expect.stringMatching(/WEIGHTS_1 is a "VEC3", but must be VEC4/),
    expect.stringMatching(/has JOINTS_1 without WEIGHTS_1/),
  ]);
});

test('a bind matrix with another last row than 0, 0, 0, 1 is repaired', async () => {
  // Moves by 1 along x; the fourth row would mix the joint's own place into the axes.
  const matrix = [1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1];
  const { warnings, positions } = await load({
    change: (json) => {
      const bytes = Buffer.from(new Float32Array([...matrix, ...matrix]).buffer);
      json['buffers'].push({
        byteLength: bytes.length,
        uri: `data:application/octet-stream;base64,${bytes.toString('base64')}`,
      });
      json['bufferViews'].push({ buffer: 1, byteLength: bytes.length });
      json['accessors'].push({ bufferView: 3, componentType: 5126, type: 'MAT4', count: 2 });
      json['skins'][0].inverseBindMatrices = 3;
    },
  });
  expect(warnings).toEqual([
    expect.stringMatching(/skin 0: the bind matrix of joint 0 is not affine/),
    expect.stringMatching(/joint 1 is not affine/),
  ]);
  expect(positions).toEqual([11, 0, 0, 12, 0, 0, 11, 1, 0]);
});

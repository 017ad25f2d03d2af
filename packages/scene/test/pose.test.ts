import { describe, expect, test } from 'vitest';
import type { Mesh } from '../src/index';
import { createRig, poseMesh } from '../src/pose/index';

const mesh: Mesh = {
  name: 'arm',
  positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2, 0]),
  indices: new Uint32Array([0, 1, 2, 1, 3, 2]),
  normals: new Float32Array([0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1]),
};
const still = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
/** A quarter turn about x, then a move by 1 along x. */
const turned = [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 1, 0, 0, 1];
const skin = {
  jointCount: 2,
  joints: new Uint16Array([0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0]),
  // None; half a weight of one joint; both joints; one.
  weights: new Float32Array([0, 0, 0, 0, 0.5, 0, 0, 0, 0.5, 0.5, 0, 0, 1, 0, 0, 0]),
};
const near = (values: ArrayLike<number> | undefined, expected: readonly number[]) =>
  Array.from(values ?? []).forEach((value, i) => expect(value).toBeCloseTo(expected[i]!, 6));

describe('poseMesh', () => {
  test('applies the skin: blended matrices, and vertices without weights stay', () => {
    const posed = poseMesh(createRig(mesh, { skin }), { joints: [...still, ...turned] });
    near(posed.positions, [0, 0, 0, 1, 0, 0, 0.5, 0.5, 0.5, 1, 0, 2]);
    near(posed.normals?.subarray(9), [0, -1, 0]);
    expect(posed.indices).toBe(mesh.indices);
  });

  test('blends targets before the skin, and normals have unit length', () => {
    const targets = [
      { positions: new Float32Array(12).fill(1) },
      { normals: new Float32Array([0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0]) },
    ];
    const posed = poseMesh(createRig(mesh, { targets }), { weights: [0.5, 1] });
    near(posed.positions, [0.5, 0.5, 0.5, 1.5, 0.5, 0.5, 0.5, 1.5, 0.5, 0.5, 2.5, 0.5]);
    near(posed.normals?.subarray(9), [0, Math.SQRT1_2, Math.SQRT1_2]);
    const both = poseMesh(createRig(mesh, { skin, targets }), { joints: [...still, ...turned], weights: [0.5] });
    near(both.positions.subarray(9), [1.5, -0.5, 2.5]);
  });

  test('without numbers is the bind pose; a copy has the vertices and no pose', () => {
    const posed = poseMesh(createRig(mesh, { skin }), {});
    near(posed.positions, Array.from(mesh.positions));
    expect(posed.pose?.rig.bind).toBe(mesh);
    const copy = structuredClone(posed);
    expect(copy.pose).toBeUndefined();
    expect(copy).toEqual({ ...mesh, positions: posed.positions, normals: posed.normals });
  });

  test('computes the vertices once, when they are first read', () => {
    const posed = poseMesh(createRig(mesh, { skin }), { joints: [...still, ...turned] });
    expect(posed.positions).toBe(posed.positions);
  });

  test.each([
    [{ joints: still }, 'scene/length'],
    [{ joints: [...still, ...turned], weights: [1] }, 'scene/length'],
    [{ joints: [...still, ...turned.map(() => NaN)] }, 'scene/not-finite'],
  ])('refuses %#', (pose, code) => {
    expect(() => poseMesh(createRig(mesh, { skin }), pose)).toThrow(expect.objectContaining({ code }));
  });
});

describe('createRig refuses', () => {
  test.each([
    ['joints of another number', { skin: { ...skin, joints: skin.joints.subarray(4) } }, 'scene/length'],
    ['a joint that does not exist', { skin: { ...skin, jointCount: 1 } }, 'scene/reference'],
    ['no joints', { skin: { ...skin, jointCount: 0 } }, 'scene/value'],
    ['negative weights', { skin: { ...skin, weights: skin.weights.map((w) => -w) } }, 'scene/value'],
    ['weights that are not finite', { skin: { ...skin, weights: skin.weights.map(() => NaN) } }, 'scene/not-finite'],
    ['targets of another length', { targets: [{ positions: new Float32Array(3) }] }, 'scene/length'],
    [
      'targets that are not finite',
      { targets: [{ normals: new Float32Array(12).fill(Infinity) }] },
      'scene/not-finite',
    ],
  ])('%s', (_, options, code) => {
    expect(() => createRig(mesh, options)).toThrow(expect.objectContaining({ code }));
  });
});

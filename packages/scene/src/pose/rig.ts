import { SceneError } from '../error';
import type { Mesh, MeshRig, MeshSkin, MorphTarget } from '../mesh';
import { createScene } from '../scene';
import { checkScene } from '../check-scene';

/** How a mesh can be posed; see {@link createRig}. */
export interface RigOptions {
  /** The joints that move each vertex. Absent: only targets do. */
  readonly skin?: MeshSkin | undefined;
  /** What can be blended in, in the order of a pose's weights. */
  readonly targets?: readonly MorphTarget[] | undefined;
}

function fault(code: 'length' | 'not-finite' | 'reference' | 'value', message: string): SceneError {
  return new SceneError(`scene/${code}`, message);
}

function expectFinite(values: Float32Array, what: string): void {
  for (let i = 0; i < values.length; i++)
    if (!Number.isFinite(values[i])) throw fault('not-finite', `${what}: number ${i} is ${values[i]}.`);
}

/**
 * A mesh that can be posed by a skin, morph targets, or both. What it is given is checked once, here, and kept: it must
 * not be changed afterwards.
 *
 * @param bind The mesh in its bind pose.
 * @throws {SceneError} `scene/length`, `scene/not-finite`, `scene/reference`, `scene/value`.
 * @example
 * const rig = createRig(mesh, { skin: { jointCount: 2, joints, weights } });
 * await tracer.replaceMesh('arm', poseMesh(rig, { joints: [...upper, ...lower] }));
 */
export function createRig(bind: Mesh, { skin, targets = [] }: RigOptions): MeshRig {
  checkScene({ ...createScene(), meshes: [bind] });
  const { name } = bind;
  const length = bind.positions.length;
  if (skin) {
    const { jointCount, joints, weights } = skin;
    if (!(Number.isInteger(jointCount) && jointCount >= 1 && jointCount <= 65536))
      throw fault('value', `${name}: jointCount is ${jointCount}; it must be a whole number from 1 to 65536.`);
    const set = (4 * length) / 3;
    if (joints.length === 0 || joints.length % set !== 0 || weights.length !== joints.length)
      throw fault(
        'length',
        `${name}: there are ${joints.length} joints and ${weights.length} weights; both must be ${set}, or a multiple of it.`,
      );
    expectFinite(weights, `${name}: weights of the skin`);
    for (let i = 0; i < joints.length; i++) {
      if ((weights[i] as number) < 0)
        throw fault('value', `${name}: weight ${i} of the skin is ${weights[i]}, below 0.`);
      if ((joints[i] as number) >= jointCount)
        throw fault(
          'reference',
          `${name}: number ${i} of the skin's joints is ${joints[i]}; there are ${jointCount} joints.`,
        );
    }
  }
  targets.forEach((target, i) => {
    for (const key of ['positions', 'normals', 'tangents'] as const) {
      const values = target[key];
      if (!values) continue;
      const what = `${name}: ${key} of morph target ${i}`;
      if (values.length !== length)
        throw fault('length', `${what} have ${values.length} numbers; they must have ${length}.`);
      expectFinite(values, what);
    }
  });
  return { bind, skin, targets };
}

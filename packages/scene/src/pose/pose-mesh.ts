import { SceneError } from '../error';
import type { Mesh, MeshPose, MeshRig } from '../mesh';
import { evaluatePose } from './evaluate';

/** Numbers of a pose; see {@link poseMesh}. */
export interface Pose {
  /**
   * Matrices of the joints from the bind pose to the pose, in object space: 16 numbers each, column-major. Absent: the
   * bind pose.
   */
  readonly joints?: ArrayLike<number> | undefined;
  /** Weights of the morph targets, in their order; those that are missing are 0. */
  readonly weights?: ArrayLike<number> | undefined;
}

/**
 * A rig in a pose: a mesh for a scene, or for `replaceMesh()` of a tracer, which poses the rig on the GPU where it can.
 * The vertices are computed when they are first read, so a call costs no more than copying its numbers.
 *
 * @throws {SceneError} `scene/length` for another number of matrices than the skin has joints, or more weights than there
 * are targets; `scene/not-finite`.
 */
export function poseMesh(rig: MeshRig, pose: Pose): Mesh {
  const { bind, skin, targets } = rig;
  const count = skin?.jointCount ?? 0;
  const joints = new Float64Array(16 * count);
  if (pose.joints) {
    if (pose.joints.length !== joints.length)
      throw new SceneError(
        'scene/length',
        `${bind.name}: the pose has ${pose.joints.length} numbers for joints; it must have ${joints.length}.`,
      );
    joints.set(pose.joints);
  } else for (let j = 0; j < count; j++) for (let k = 0; k < 4; k++) joints[16 * j + 5 * k] = 1;
  const weights = new Float64Array(targets.length);
  if ((pose.weights?.length ?? 0) > weights.length)
    throw new SceneError(
      'scene/length',
      `${bind.name}: the pose has ${pose.weights?.length} weights; there are ${targets.length} morph targets.`,
    );
  weights.set(pose.weights ?? []);
  for (const values of [joints, weights])
    if (!values.every(Number.isFinite))
      throw new SceneError('scene/not-finite', `${bind.name}: the pose has numbers that are not finite.`);
  return posed({ rig, joints, weights });
}

/** A mesh whose vertices are computed when they are first read. */
function posed(pose: MeshPose): Mesh {
  const { bind } = pose.rig;
  let known: Mesh | undefined;
  const mesh: Mesh = { ...bind };
  // Not enumerable: a copy of the mesh has its vertices, and is one without a pose.
  Object.defineProperty(mesh, 'pose', { value: pose });
  for (const key of ['positions', 'normals', 'tangents'] as const)
    if (bind[key])
      Object.defineProperty(mesh, key, { enumerable: true, get: () => (known ??= evaluatePose(pose))[key] });
  return mesh;
}

import type { MeshRig } from '@glanz/scene';
import { createRig, type Pose } from '@glanz/scene/pose';
import { addSphere, createScene, lambert } from './scenes';

/**
 * A ball with normals and tangents, of two joints, the upper half of which the second one moves, and two morph targets:
 * one stretches it, the other only turns its normals and tangents.
 */
export function rigOf(segments = 24, { joints = true, tangents = true } = {}): MeshRig {
  const scene = createScene();
  addSphere(scene, 0.4, [0, 0, 0.2], lambert(0.5, 0.5, 0.5), segments);
  const [mesh] = scene.meshes;
  if (!mesh?.normals) throw new Error('no sphere');
  const { positions, normals } = mesh;
  const vertices = positions.length / 3;
  const along = new Float32Array(4 * vertices);
  const weights = new Float32Array(4 * vertices);
  const names = new Uint16Array(4 * vertices);
  for (let v = 0; v < vertices; v++) {
    const [x, y, z] = [0, 1, 2].map((k) => normals[3 * v + k]!) as [number, number, number];
    const length = Math.hypot(x, z) || 1;
    along.set([-z / length, 0, x / length, v % 2 ? 1 : -1], 4 * v);
    // The lowest vertices have no joint; sums are not 1.
    const upper = Math.min(1, Math.max(0, 0.5 + y));
    weights.set(y < -0.9 ? [0, 0, 0, 0] : [1 - upper, upper, 0.25, 0], 4 * v);
    names.set([0, 1, 0, 1], 4 * v);
  }
  const skin = { jointCount: 2, joints: names, weights };
  const stretch = positions.map((p, i) => (i % 3 === 1 ? 0.5 * p : 0.1 * Math.sin(7 * p)));
  const turn = positions.map((p) => 0.3 * Math.cos(9 * p));
  const bind = { ...mesh, name: 'body', ...(tangents ? { tangents: along } : {}) };
  return createRig(bind, {
    ...(joints ? { skin } : {}),
    targets: [{ positions: stretch }, { normals: turn, tangents: turn }],
  });
}

/** A pose: the upper joint rotates about z and moves, the lower one is mirrored in x where asked for. */
export function poseOf(angle: number, weights: readonly number[] = [], mirrored = false): Pose {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const lower = [mirrored ? -1 : 1, 0, 0, 0, 0, 1.1, 0, 0, 0, 0, 0.9, 0, 0, 0, 0, 1];
  return { joints: [...lower, c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, 0.2 * s, 0.1 * c, 0.05, 1], weights };
}

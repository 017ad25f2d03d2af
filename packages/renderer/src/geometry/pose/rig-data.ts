import type { Mesh, MeshPose, MeshRig } from '@glanz/scene';

/** What the kernel reads of a rig. */
export interface RigData {
  readonly bind: Float32Array<ArrayBuffer>;
  readonly influences: Uint32Array<ArrayBuffer>;
  readonly targets: Float32Array<ArrayBuffer>;
}

/** Attributes of a mesh that poses change: tangents only beside normals. */
export const posedAttributes = ({ normals, tangents }: Mesh): number => (normals ? (tangents ? 3 : 2) : 1);

/** Lists of four joints for each vertex. */
export const setsOf = ({ bind, skin }: MeshRig): number =>
  skin ? (3 * skin.joints.length) / (4 * bind.positions.length) : 0;

/** Packs a rig for the kernel. */
export function packRig({ bind: mesh, skin, targets }: MeshRig): RigData {
  const count = mesh.positions.length;
  const lists = [mesh.positions, mesh.normals, mesh.normals && mesh.tangents].filter((list) => list !== undefined);
  const bind = new Float32Array(lists.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const list of lists) {
    bind.set(list, at);
    at += list.length;
  }
  const influences = new Uint32Array(skin ? 1.5 * skin.joints.length : 0);
  if (skin) {
    new Uint16Array(influences.buffer).set(skin.joints);
    new Float32Array(influences.buffer).set(skin.weights, skin.joints.length / 2);
  }
  const added = new Float32Array(targets.length * lists.length * count);
  targets.forEach((target, i) =>
    [target.positions, target.normals, target.tangents]
      .slice(0, lists.length)
      .forEach((list, k) => list && added.set(list, (i * lists.length + k) * count)),
  );
  return { bind, influences, targets: added };
}

/**
 * Words of a pose for the kernel, with the targets that have a weight; undefined where single precision cannot hold
 * them.
 */
export function packPose({
  rig,
  joints,
  weights,
}: MeshPose): { data: Float32Array<ArrayBuffer>; targets: number } | undefined {
  const count = rig.skin?.jointCount ?? 0;
  const data = new Float32Array(12 * count + 2 * weights.length);
  const words = new Uint32Array(data.buffer);
  for (let j = 0; j < count; j++)
    for (let k = 0; k < 12; k++) data[12 * j + k] = joints[16 * j + 4 * Math.floor(k / 3) + (k % 3)] as number;
  let targets = 0;
  weights.forEach((weight, i) => {
    if (weight === 0) return;
    words[12 * count + 2 * targets] = i;
    data[12 * count + 2 * targets + 1] = weight;
    targets++;
  });
  const isFinite = (at: number) => Number.isFinite(data[at]);
  for (let i = 0; i < 12 * count; i++) if (!isFinite(i)) return undefined;
  for (let i = 0; i < targets; i++) if (!isFinite(12 * count + 2 * i + 1)) return undefined;
  return { data, targets };
}

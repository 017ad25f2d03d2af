import { multiply } from 'gl-matrix/esm/mat4.js';
import { numbersFrom, transformNormal, transformPoint, type Mat4 } from './matrix';
import type { Attribute, Matrix, ThreeMesh } from './types';

interface Skeleton {
  readonly bones: readonly { readonly matrixWorld: Matrix }[];
  readonly boneInverses: readonly Matrix[];
}

/** Vertices of a mesh as its morph targets and its bones have them now, in its own space. */
export interface Posed {
  readonly positions: Float32Array<ArrayBuffer>;
  readonly normals: Float32Array<ArrayBuffer> | undefined;
}

/** Poses a mesh; `undefined` for one that has nothing to be posed by. */
export function poseVertices(mesh: ThreeMesh): Posed | undefined {
  const { geometry, morphTargetInfluences: influences = [] } = mesh;
  const targets = geometry.morphAttributes['position'] ?? [];
  const morphed = targets.length > 0 && influences.some((influence) => influence !== 0);
  if (!morphed && !mesh.isSkinnedMesh) return undefined;
  const position = geometry.attributes['position'] as Attribute;
  const normal = geometry.attributes['normal'];
  const positions = read(position);
  const normals = normal && read(normal);
  if (morphed) {
    morph(positions, targets, influences, geometry.morphTargetsRelative);
    if (normals) morph(normals, geometry.morphAttributes['normal'] ?? [], influences, geometry.morphTargetsRelative);
  }
  if (mesh.isSkinnedMesh) skin(mesh, positions, normals);
  return { positions, normals };
}

function read(attribute: Attribute): Float32Array<ArrayBuffer> {
  const numbers = new Float32Array(attribute.count * 3);
  for (let i = 0; i < attribute.count; i++)
    for (let k = 0; k < 3; k++) numbers[3 * i + k] = attribute.getComponent(i, k);
  return numbers;
}

/** Targets hold differences, or (older ones) vertices of their own, towards which the base moves. */
function morph(
  vertices: Float32Array,
  targets: readonly Attribute[],
  influences: readonly number[],
  relative: boolean,
): void {
  const base = relative ? undefined : vertices.slice();
  targets.forEach((target, t) => {
    const influence = influences[t] ?? 0;
    if (influence === 0) return;
    for (let i = 0; i < target.count; i++)
      for (let k = 0; k < 3; k++) {
        const at = 3 * i + k;
        vertices[at] =
          (vertices[at] as number) + influence * (target.getComponent(i, k) - (base ? (base[at] as number) : 0));
      }
  });
}

function skin(mesh: ThreeMesh, positions: Float32Array, normals: Float32Array | undefined): void {
  const { skeleton, bindMatrix, bindMatrixInverse } = mesh as unknown as {
    readonly skeleton: Skeleton;
    readonly bindMatrix: Matrix;
    readonly bindMatrixInverse: Matrix;
  };
  const { skinIndex, skinWeight } = mesh.geometry.attributes;
  if (!skeleton || !skinIndex || !skinWeight) return;
  const bones = skeleton.bones.map(({ matrixWorld }, i) =>
    multiply(new Float64Array(16), matrixWorld.elements, (skeleton.boneInverses[i] as Matrix).elements),
  );
  const [bind, back] = [numbersFrom(bindMatrix), numbersFrom(bindMatrixInverse)];
  for (let i = 0; i < positions.length / 3; i++) {
    const sum: Mat4 = new Float64Array(16);
    for (let j = 0; j < 4; j++) {
      const weight = skinWeight.getComponent(i, j);
      const bone = bones[skinIndex.getComponent(i, j)];
      if (weight !== 0 && bone) for (let k = 0; k < 16; k++) sum[k] = (sum[k] as number) + weight * (bone[k] as number);
    }
    const whole = multiply(sum, back, multiply(sum, sum, bind));
    transformPoint(whole, positions, 3 * i);
    if (normals) transformNormal(whole, normals, 3 * i);
  }
}

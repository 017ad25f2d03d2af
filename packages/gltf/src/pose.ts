import type { Mesh, SceneWarning } from '@glanz/scene';
import { identity, multiply, type Matrix } from './matrix';
import type { PrimitiveData } from './primitive';

/** A mesh with its morph targets blended in by `weights` (glTF 2.0, section 3.7.2.2). */
export function morphed(mesh: Mesh, primitive: PrimitiveData, weights: readonly number[]): Mesh {
  const add = (values: Float32Array<ArrayBuffer> | undefined, semantic: string, stride: number) => {
    if (!values) return undefined;
    const sum = values.slice();
    primitive.json.targets?.forEach((_, index) => {
      const weight = weights[index] ?? 0;
      const deltas = weight === 0 ? undefined : primitive.target(index, semantic);
      if (!deltas) return;
      for (let v = 0; 3 * v < deltas.length && stride * v < sum.length; v++) {
        for (let k = 0; k < 3; k++) {
          const moved = Math.fround((sum[stride * v + k] as number) + weight * (deltas[3 * v + k] as number));
          if (Number.isFinite(moved)) sum[stride * v + k] = moved;
        }
      }
    });
    return sum;
  };
  const result: Mesh = { ...mesh, positions: add(mesh.positions, 'POSITION', 3) as Float32Array<ArrayBuffer> };
  const normals = add(mesh.normals, 'NORMAL', 3);
  if (normals) result.normals = normals;
  const tangents = add(mesh.tangents, 'TANGENT', 4);
  if (tangents) result.tangents = tangents;
  return result;
}

/**
 * Matrices of a skeleton's joints: from where a vertex is bound to where it is in the world. Those that are not finite are
 * undefined, with a warning.
 * @param bind Inverse bind matrices, one after the other; absent: all are the identity.
 * @param world World transforms of the nodes.
 */
export function jointMatrices(name: string, joints: readonly number[], bind: Float32Array | undefined, world: ReadonlyMap<number, Matrix>, warnings: SceneWarning[]): readonly (Matrix | undefined)[] {
  return joints.map((joint, j) => {
    const own = bind?.subarray(16 * j, 16 * j + 16);
    const at = world.get(joint) ?? identity();
    if (own && !own.every(Number.isFinite)) {
      warnings.push({ code: 'gltf/skin', message: `${name}: the bind matrix of joint ${j} is not finite; the joint does not count.` });
      return undefined;
    }
    return own ? multiply(at, own) : at;
  });
}

/**
 * A mesh in the pose of its skeleton, in the world (glTF 2.0, section 3.7.3.3: the node's own transform does not count).
 * Weights that are not finite do not count, with a warning.
 */
export function skinned(mesh: Mesh, primitive: PrimitiveData, matrices: readonly (Matrix | undefined)[], warnings: SceneWarning[]): Mesh {
  const warn = (message: string) => void warnings.push({ code: 'gltf/skin', message: `${mesh.name}: ${message}` });
  const sets: { joints: Float32Array; weights: Float32Array }[] = [];
  for (let set = 0; ; set++) {
    if (primitive.count(`JOINTS_${set}`) === undefined || primitive.count(`WEIGHTS_${set}`) === undefined) break;
    const weights = primitive.floats(`WEIGHTS_${set}`, 4);
    if (!weights.every(Number.isFinite)) warn(`WEIGHTS_${set} holds numbers that are not finite; they do not count.`);
    sets.push({ joints: primitive.floats(`JOINTS_${set}`, 4), weights });
  }
  const vertices = mesh.positions.length / 3;
  const positions = new Float32Array(mesh.positions.length);
  const normals = mesh.normals && new Float32Array(mesh.normals.length);
  const tangents = mesh.tangents?.slice();
  const blended = new Float64Array(16);
  for (let v = 0; v < vertices; v++) {
    blended.fill(0);
    let total = 0;
    for (const { joints: indices, weights } of sets) {
      for (let k = 0; k < 4; k++) {
        const weight = weights[4 * v + k] as number;
        const matrix = matrices[indices[4 * v + k] as number];
        if (!(weight > 0 && weight < Infinity) || !matrix) continue;
        total += weight;
        for (let i = 0; i < 16; i++) blended[i] = (blended[i] as number) + weight * (matrix[i] as number);
      }
    }
    // A vertex without weights stays where it is.
    if (total === 0) blended.set([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    else for (let i = 0; i < 16; i++) blended[i] = (blended[i] as number) / total;
    transformVector(blended, mesh.positions, positions, 3 * v, 1);
    if (normals && mesh.normals) transformNormal(blended, mesh.normals, normals, 3 * v);
    if (tangents && mesh.tangents) {
      transformVector(blended, mesh.tangents, tangents, 4 * v, 0);
      normalize(tangents, 4 * v);
    }
  }
  const result: Mesh = { ...mesh, positions };
  if (normals) result.normals = normals;
  if (tangents) result.tangents = tangents;
  return result;
}

function transformVector(m: Float64Array, source: Float32Array, out: Float32Array, at: number, w: number): void {
  const x = source[at] as number, y = source[at + 1] as number, z = source[at + 2] as number;
  for (let r = 0; r < 3; r++) {
    const value = Math.fround((m[r] as number) * x + (m[4 + r] as number) * y + (m[8 + r] as number) * z + (m[12 + r] as number) * w);
    out[at + r] = Number.isFinite(value) ? value : 0;
  }
}

/** By the cofactors, which are the inverse transpose times the determinant. */
function transformNormal(m: Float64Array, source: Float32Array, out: Float32Array, at: number): void {
  const c = (a: number, b: number) => (m[a] as number) * (m[b] as number);
  const x = source[at] as number, y = source[at + 1] as number, z = source[at + 2] as number;
  const cofactors = [
    c(5, 10) - c(6, 9), c(6, 8) - c(4, 10), c(4, 9) - c(5, 8),
    c(9, 2) - c(10, 1), c(10, 0) - c(8, 2), c(8, 1) - c(9, 0),
    c(1, 6) - c(2, 5), c(2, 4) - c(0, 6), c(0, 5) - c(1, 4),
  ];
  const determinant = (m[0] as number) * (cofactors[0] as number) + (m[1] as number) * (cofactors[1] as number) + (m[2] as number) * (cofactors[2] as number);
  const sign = determinant < 0 ? -1 : 1;
  for (let r = 0; r < 3; r++) {
    // Row r of the cofactor matrix, which is stored column by column of m.
    const value = Math.fround(sign * ((cofactors[r] as number) * x + (cofactors[3 + r] as number) * y + (cofactors[6 + r] as number) * z));
    out[at + r] = Number.isFinite(value) ? value : 0;
  }
  normalize(out, at);
}

function normalize(values: Float32Array, at: number): void {
  const length = Math.hypot(values[at] as number, values[at + 1] as number, values[at + 2] as number);
  if (length > 0) for (let k = 0; k < 3; k++) values[at + k] = (values[at + k] as number) / length;
}

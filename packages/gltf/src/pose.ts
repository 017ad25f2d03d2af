import type { Mesh, SceneWarning } from '@glanz/scene';
import { adjoint, determinant, fromMat4, transpose } from 'gl-matrix/esm/mat3.js';
import { multiply } from 'gl-matrix/esm/mat4.js';
import { add, scale, transformMat3 } from 'gl-matrix/esm/vec3.js';
import { identity, type Matrix } from './matrix';
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

/** With a tolerance, since exporters invert matrices in single precision. */
const isAffine = (m: Float32Array): boolean =>
  [0, 0, 0, 1].every((x, k) => Math.abs((m[4 * k + 3] as number) - x) < 1e-3);

/**
 * Matrices of a skeleton's joints, from the bind pose to world space. Those that are not finite are undefined, with a
 * warning.
 * @param bind Inverse bind matrices, concatenated; undefined: all are the identity.
 * @param world World transforms of the nodes.
 */
export function jointMatrices(
  name: string,
  joints: readonly number[],
  bind: Float32Array | undefined,
  world: ReadonlyMap<number, Matrix>,
  warnings: SceneWarning[],
): readonly (Matrix | undefined)[] {
  return joints.map((joint, j) => {
    const own = bind?.subarray(16 * j, 16 * j + 16);
    const at = world.get(joint) ?? identity();
    if (own && !own.every(Number.isFinite)) {
      warnings.push({
        code: 'gltf/skin',
        message: `${name}: the bind matrix of joint ${j} is not finite; the joint is ignored.`,
      });
      return undefined;
    }
    if (own && !isAffine(own)) {
      warnings.push({
        code: 'gltf/skin',
        message: `${name}: the bind matrix of joint ${j} is not affine; its last row is read as 0, 0, 0, 1.`,
      });
      return multiply(
        identity(),
        at,
        own.map((x, i) => (i % 4 < 3 ? x : i === 15 ? 1 : 0)),
      );
    }
    return own ? multiply(identity(), at, own) : at;
  });
}

/** Which joints move each vertex, and how much: four of each for every vertex. */
export interface Influences {
  readonly joints: Float32Array;
  readonly weights: Float32Array;
}

/**
 * Max deviation of a vertex's weights from a sum of 1 before a warning: four sets of 8-bit weights round by this much.
 */
const SUM_TOLERANCE = 0.05;

/** Whether a primitive has joints and weights. */
export const isSkinnable = ({ attributes }: { readonly attributes: object }): boolean =>
  'JOINTS_0' in attributes && 'WEIGHTS_0' in attributes;

/**
 * The sets of influences of a primitive. Weights that are not finite or below 0, and joints that do not exist, have no
 * effect, with a warning.
 */
export function influencesOf(
  name: string,
  primitive: PrimitiveData,
  vertices: number,
  joints: number,
  warnings: SceneWarning[],
): Influences[] {
  const warn = (message: string) => void warnings.push({ code: 'gltf/skin', message: `${name}: ${message}` });
  const sets: Influences[] = [];
  const sums = new Float64Array(vertices);
  for (let set = 0; ; set++) {
    const semantics = [`JOINTS_${set}`, `WEIGHTS_${set}`] as const;
    const [jointCount, weightCount] = semantics.map((semantic) => primitive.count(semantic));
    // checkMeshes() has reported one without the other.
    if (jointCount === undefined || weightCount === undefined) break;
    if (jointCount !== vertices || weightCount !== vertices) {
      warn(
        `${semantics.join(' and ')} have ${jointCount} and ${weightCount} entries for ${vertices} vertices and are ignored.`,
      );
      continue;
    }
    const influences = { joints: primitive.floats(semantics[0], 4), weights: primitive.floats(semantics[1], 4) };
    let infinite = 0,
      negative = 0,
      beyond = 0;
    for (let i = 0; i < influences.weights.length; i++) {
      const weight = influences.weights[i] as number;
      if (!Number.isFinite(weight)) infinite++;
      else if (weight < 0) negative++;
      else sums[i >> 2] = (sums[i >> 2] as number) + weight;
      if ((influences.joints[i] as number) >= joints) beyond++;
    }
    if (infinite > 0) warn(`${semantics[1]} holds numbers that are not finite; they are ignored.`);
    if (negative > 0) warn(`${semantics[1]} holds ${negative} negative numbers; they are ignored.`);
    if (beyond > 0)
      warn(
        `${semantics[0]} names a joint that does not exist ${beyond} times (the skin has ${joints}); it is ignored.`,
      );
    sets.push(influences);
  }
  const off = sums.reduce((count, sum) => count + (Math.abs(sum - 1) > SUM_TOLERANCE ? 1 : 0), 0);
  if (sets.length > 0 && off > 0)
    warn(
      `the weights of ${off} vertices do not add up to 1; they are scaled, and vertices without any stay where they are.`,
    );
  return sets;
}

/**
 * A mesh in the pose of its skeleton, in world space (glTF 2.0, section 3.7.3.3: the node's own transform is ignored).
 *
 * @param sets Of {@link influencesOf}.
 */
export function skinned(mesh: Mesh, sets: readonly Influences[], matrices: readonly (Matrix | undefined)[]): Mesh {
  const vertices = mesh.positions.length / 3;
  const positions = new Float32Array(mesh.positions.length);
  const normals = mesh.normals && new Float32Array(mesh.normals.length);
  const tangents = mesh.tangents?.slice();
  const blended = new Float64Array(16),
    translation = blended.subarray(12);
  const linear = new Float64Array(9),
    cofactors = new Float64Array(9);
  const vector: [number, number, number] = [0, 0, 0];
  /** A vector of `source`, multiplied by a 3 × 3 matrix. */
  const transformed = (source: Float32Array, at: number, matrix: Float64Array) => {
    for (let k = 0; k < 3; k++) vector[k] = source[at + k] as number;
    return transformMat3(vector, vector, matrix);
  };
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
    fromMat4(linear, blended);
    write(positions, 3 * v, add(vector, transformed(mesh.positions, 3 * v, linear), translation));
    if (normals && mesh.normals) {
      // The cofactors are the inverse transpose times the determinant.
      transpose(cofactors, adjoint(cofactors, linear));
      write(
        normals,
        3 * v,
        scale(vector, transformed(mesh.normals, 3 * v, cofactors), determinant(linear) < 0 ? -1 : 1),
      );
      normalize(normals, 3 * v);
    }
    if (tangents && mesh.tangents) {
      write(tangents, 4 * v, transformed(mesh.tangents, 4 * v, linear));
      normalize(tangents, 4 * v);
    }
  }
  const result: Mesh = { ...mesh, positions };
  if (normals) result.normals = normals;
  if (tangents) result.tangents = tangents;
  return result;
}

/** Numbers that are not finite in single precision become 0. */
function write(out: Float32Array, at: number, vector: readonly number[]): void {
  for (let k = 0; k < 3; k++) {
    const value = Math.fround(vector[k] as number);
    out[at + k] = Number.isFinite(value) ? value : 0;
  }
}

function normalize(values: Float32Array, at: number): void {
  const length = Math.hypot(values[at] as number, values[at + 1] as number, values[at + 2] as number);
  if (length > 0) for (let k = 0; k < 3; k++) values[at + k] = (values[at + k] as number) / length;
}

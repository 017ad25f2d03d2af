import type { MeshSkin, MorphTarget, SceneWarning } from '@glanz/scene';
import { multiply } from 'gl-matrix/esm/mat4.js';
import { identity, type Matrix } from './matrix';
import type { PrimitiveData } from './primitive';

const TARGET_KEYS = { positions: 'POSITION', normals: 'NORMAL', tangents: 'TANGENT' } as const;

/** The morph targets of a primitive. Those whose weight is 0 may be left empty: see `isUsed`. */
export function targetsOf(primitive: PrimitiveData, isUsed: (index: number) => boolean = () => true): MorphTarget[] {
  return (primitive.json.targets ?? []).map((_, index) =>
    isUsed(index)
      ? Object.fromEntries(
          Object.entries(TARGET_KEYS).map(([key, semantic]) => [key, primitive.target(index, semantic)]),
        )
      : {},
  );
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
 * The skin of a primitive: influences that have no effect get the weight 0.
 *
 * @param sets Of {@link influencesOf}.
 * @param matrices Of {@link jointMatrices}; undefined: the joint has no effect.
 */
export function skinOf(sets: readonly Influences[], matrices: readonly (Matrix | undefined)[]): MeshSkin {
  const { length = 0 } = sets[0]?.joints ?? {};
  const joints = new Uint16Array(sets.length * length);
  const weights = new Float32Array(sets.length * length);
  sets.forEach((set, nth) => {
    for (let i = 0; i < length; i++) {
      const weight = set.weights[i] as number,
        joint = set.joints[i] as number;
      if (!(weight > 0 && weight < Infinity) || !matrices[joint]) continue;
      joints[nth * length + i] = joint;
      weights[nth * length + i] = weight;
    }
  });
  return { jointCount: matrices.length, joints, weights };
}

const numbersOf = new WeakMap<readonly (Matrix | undefined)[], Float64Array<ArrayBuffer>>();

/** Matrices of joints as poses have them; those without effect are 0. Many nodes may have the same skin: made once. */
export function jointNumbers(matrices: readonly (Matrix | undefined)[]): Float64Array<ArrayBuffer> {
  let numbers = numbersOf.get(matrices);
  if (!numbers) {
    numbers = new Float64Array(16 * matrices.length);
    for (const [j, matrix] of matrices.entries()) if (matrix) numbers.set(matrix, 16 * j);
    numbersOf.set(matrices, numbers);
  }
  return numbers;
}

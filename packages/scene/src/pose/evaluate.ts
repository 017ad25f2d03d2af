import type { Mesh, MeshPose, MeshSkin, MorphTarget } from '../mesh';
import { unitNormals } from './normals';

/** Adds weighted targets to `values`, in place. Sums that are not finite in single precision are left out. */
function addTargets(
  values: Float32Array,
  stride: number,
  targets: readonly (Float32Array | undefined)[],
  weights: ArrayLike<number>,
): void {
  targets.forEach((deltas, index) => {
    const weight = weights[index] ?? 0;
    if (weight === 0 || !deltas) return;
    for (let v = 0; 3 * v < deltas.length && stride * v < values.length; v++) {
      for (let k = 0; k < 3; k++) {
        const moved = Math.fround((values[stride * v + k] as number) + weight * (deltas[3 * v + k] as number));
        if (Number.isFinite(moved)) values[stride * v + k] = moved;
      }
    }
  });
}

/** A mesh with morph targets blended in (glTF 2.0, section 3.7.2.2). Its normals may need {@link unitNormals}. */
export function blendTargets(mesh: Mesh, targets: readonly MorphTarget[], weights: ArrayLike<number>): Mesh {
  const blended = (key: 'positions' | 'normals' | 'tangents', stride: number) => {
    const values = mesh[key]?.slice();
    if (values)
      addTargets(
        values,
        stride,
        targets.map((target) => target[key]),
        weights,
      );
    return values;
  };
  const [positions, normals, tangents] = [blended('positions', 3), blended('normals', 3), blended('tangents', 4)];
  return {
    ...mesh,
    positions: positions as Float32Array<ArrayBuffer>,
    ...(normals ? { normals } : {}),
    ...(tangents ? { tangents } : {}),
  };
}

/**
 * A mesh with a skin applied (glTF 2.0, section 3.7.3.3).
 *
 * @param joints 16 numbers a joint, column-major.
 */
export function applySkin(mesh: Mesh, skin: MeshSkin, joints: ArrayLike<number>): Mesh {
  const vertices = mesh.positions.length / 3;
  const sets = skin.joints.length / (4 * vertices);
  const positions = new Float32Array(mesh.positions.length);
  const normals = mesh.normals && new Float32Array(mesh.normals.length);
  const tangents = mesh.tangents?.slice();
  /** Rows of three, column-major: the linear part and its cofactors, which are its inverse transpose times `det`. */
  const m = new Float64Array(12);
  const c = new Float64Array(9);
  for (let v = 0; v < vertices; v++) {
    m.fill(0);
    let total = 0;
    for (let set = 0; set < sets; set++) {
      for (let i = 4 * (set * vertices + v), end = i + 4; i < end; i++) {
        const weight = skin.weights[i] as number;
        if (weight === 0) continue;
        const at = 16 * (skin.joints[i] as number);
        total += weight;
        for (let column = 0; column < 4; column++)
          for (let k = 0; k < 3; k++)
            m[3 * column + k] = (m[3 * column + k] as number) + weight * (joints[at + 4 * column + k] as number);
      }
    }
    // A vertex without weights stays where it is.
    if (total === 0) m[0] = m[4] = m[8] = 1;
    else for (let i = 0; i < 12; i++) m[i] = (m[i] as number) / total;
    transform(positions, 3 * v, mesh.positions, 3 * v, m);
    for (let k = 0; k < 3; k++) {
      const moved = Math.fround((vector[k] as number) + (m[9 + k] as number));
      positions[3 * v + k] = Number.isFinite(moved) ? moved : 0;
    }
    if (normals && mesh.normals) {
      const sign = cofactors(m, c) < 0 ? -1 : 1;
      transform(normals, 3 * v, mesh.normals, 3 * v, c, sign);
      normalize(normals, 3 * v);
    }
    if (tangents && mesh.tangents) {
      transform(tangents, 4 * v, mesh.tangents, 4 * v, m);
      normalize(tangents, 4 * v);
    }
  }
  return { ...mesh, positions, ...(normals ? { normals } : {}), ...(tangents ? { tangents } : {}) };
}

/** What {@link transform} has computed last, in double precision. */
const vector = new Float64Array(3);

/** Multiplies a vector by a 3 × 3 matrix. Numbers that are not finite in single precision become 0. */
function transform(to: Float32Array, at: number, from: Float32Array, first: number, m: Float64Array, factor = 1): void {
  const x = from[first] as number,
    y = from[first + 1] as number,
    z = from[first + 2] as number;
  for (let k = 0; k < 3; k++) {
    vector[k] = factor * (x * (m[k] as number) + y * (m[3 + k] as number) + z * (m[6 + k] as number));
    const value = Math.fround(vector[k] as number);
    to[at + k] = Number.isFinite(value) ? value : 0;
  }
}

/** Sets `c` to the cofactors of a 3 × 3 matrix. @returns Its determinant. */
function cofactors(m: Float64Array, c: Float64Array): number {
  for (let column = 0; column < 3; column++) {
    const a = 3 * ((column + 1) % 3),
      b = 3 * ((column + 2) % 3);
    for (let k = 0; k < 3; k++) {
      const i = (k + 1) % 3,
        j = (k + 2) % 3;
      c[3 * column + k] = (m[a + i] as number) * (m[b + j] as number) - (m[a + j] as number) * (m[b + i] as number);
    }
  }
  return (
    (m[0] as number) * (c[0] as number) + (m[1] as number) * (c[1] as number) + (m[2] as number) * (c[2] as number)
  );
}

function normalize(values: Float32Array, at: number): void {
  const length = Math.hypot(values[at] as number, values[at + 1] as number, values[at + 2] as number);
  if (length > 0) for (let k = 0; k < 3; k++) values[at + k] = (values[at + k] as number) / length;
}

/** The vertices of a pose. */
export function evaluatePose({ rig, joints, weights }: MeshPose): Mesh {
  const { bind, skin, targets } = rig;
  const isBlended = targets.length > 0 && weights.some((weight) => weight !== 0);
  let mesh = isBlended ? blendTargets(bind, targets, weights) : bind;
  if (skin) mesh = applySkin(mesh, skin, joints);
  // Blended normals are shorter than 1 and may cancel out.
  if ((skin || isBlended) && mesh.normals) unitNormals(mesh.normals, mesh.positions, mesh.indices, () => undefined);
  return mesh;
}

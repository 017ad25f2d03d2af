import { determinant, fromMat4 } from 'gl-matrix/esm/mat3.js';
import { fromMat3 } from 'gl-matrix/esm/quat.js';

/** Where a node of glTF is, by its properties. */
export interface Trs {
  readonly translation: readonly number[];
  /** Unit quaternion xyzw. */
  readonly rotation: readonly number[];
  readonly scale: readonly number[];
}

/** Cosine of the angle between axes that count as perpendicular: numbers of files have single precision. */
const PERPENDICULAR = 1e-6;

const columnsOf = (m: ArrayLike<number>): number[][] =>
  [0, 1, 2].map((column) => Array.from({ length: 3 }, (_, row) => m[3 * column + row] as number));
const dot = (a: readonly number[], b: readonly number[]) => a.reduce((sum, x, i) => sum + x * (b[i] as number), 0);

/** Rotates two columns of a matrix in their plane. */
function turn(m: number[][], p: number, q: number, cosine: number, sine: number): void {
  const [a, b] = [m[p] as number[], m[q] as number[]];
  m[p] = a.map((x, i) => cosine * x - sine * (b[i] as number));
  m[q] = a.map((x, i) => sine * x + cosine * (b[i] as number));
}

/**
 * An affine transform as nodes of glTF, the outermost first: one, or, where it shears, two, because a node cannot shear.
 * The singular value decomposition, by one-sided Jacobi rotations.
 *
 * @param matrix 16 numbers, column-major, with a determinant that is not 0.
 */
export function asNodes(matrix: ArrayLike<number>): [Trs] | [Trs, Trs] {
  const axes = columnsOf(fromMat4(new Array<number>(9), matrix));
  const inner = columnsOf([1, 0, 0, 0, 1, 0, 0, 0, 1]);
  let sheared = false;
  for (let sweep = 0, changed = true; changed && sweep < 32; sweep++) {
    changed = false;
    for (const [p, q] of [
      [0, 1],
      [0, 2],
      [1, 2],
    ] as const) {
      const [a, b] = [axes[p] as number[], axes[q] as number[]];
      const [aa, bb, ab] = [dot(a, a), dot(b, b), dot(a, b)];
      if (Math.abs(ab) <= (sheared ? 1e-12 : PERPENDICULAR) * Math.sqrt(aa * bb)) continue;
      changed = sheared = true;
      const zeta = (bb - aa) / (2 * ab);
      const tangent = (zeta < 0 ? -1 : 1) / (Math.abs(zeta) + Math.sqrt(1 + zeta * zeta));
      const cosine = 1 / Math.sqrt(1 + tangent * tangent);
      turn(axes, p, q, cosine, cosine * tangent);
      turn(inner, p, q, cosine, cosine * tangent);
    }
  }
  const lengths = axes.map((axis) => Math.sqrt(dot(axis, axis)));
  // A mirror image is a negative factor: the axes are those of a rotation then.
  if (determinant(axes.flat()) < 0) lengths[0] = -(lengths[0] as number);
  const outer: Trs = {
    translation: [12, 13, 14].map((i) => matrix[i] as number),
    rotation: fromMat3(
      [0, 0, 0, 1],
      axes.flatMap((axis, i) => axis.map((x) => x / (lengths[i] as number))),
    ),
    scale: lengths,
  };
  if (!sheared) return [outer];
  const transposed = [0, 1, 2].flatMap((row) => inner.map((column) => column[row] as number));
  return [outer, { translation: [0, 0, 0], rotation: fromMat3([0, 0, 0, 1], transposed), scale: [1, 1, 1] }];
}

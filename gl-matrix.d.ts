// gl-matrix declares types for 'gl-matrix' alone. Sources here import single modules, which every bundler tree-shakes;
// these are the functions that they use, over any kind of array.

/** What a function writes into, and gives back. It may be one of the arguments. */
interface GlMatrixOut {
  [index: number]: number;
}

declare module 'gl-matrix/esm/vec3.js' {
  type V = ArrayLike<number>;
  type Triple = [number, number, number];
  export function add(out: Triple, a: V, b: V): Triple;
  export function subtract(out: Triple, a: V, b: V): Triple;
  export function cross(out: Triple, a: V, b: V): Triple;
  export function lerp(out: Triple, a: V, b: V, t: number): Triple;
  export function scale(out: Triple, a: V, factor: number): Triple;
  /** a + factor · b */
  export function scaleAndAdd(out: Triple, a: V, b: V, factor: number): Triple;
  /** Through a column-major 3 × 3 matrix. */
  export function transformMat3<Out extends GlMatrixOut>(out: Out, vector: V, m: V): Out;
  export function distance(a: V, b: V): number;
  export function dot(a: V, b: V): number;
}

declare module 'gl-matrix/esm/mat3.js' {
  type M = ArrayLike<number>;
  export function determinant(m: M): number;
  /** The transpose of the cofactors. */
  export function adjoint<Out extends GlMatrixOut>(out: Out, m: M): Out;
  export function transpose<Out extends GlMatrixOut>(out: Out, m: M): Out;
  /** The upper left 3 × 3 of a 4 × 4 matrix. */
  export function fromMat4<Out extends GlMatrixOut>(out: Out, m: M): Out;
}

declare module 'gl-matrix/esm/mat4.js' {
  type M = ArrayLike<number>;
  /** a · b: b first, then a. */
  export function multiply<Out extends GlMatrixOut>(out: Out, a: M, b: M): Out;
  /** `null` where the matrix has no inverse. */
  export function invert<Out extends GlMatrixOut>(out: Out, m: M): Out | null;
  /** Scaled, then rotated by the unit quaternion xyzw, then translated. */
  export function fromRotationTranslationScale<Out extends GlMatrixOut>(
    out: Out,
    rotation: M,
    translation: M,
    scale: M,
  ): Out;
}

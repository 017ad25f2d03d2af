// gl-matrix declares types for 'gl-matrix' alone. Sources here import single modules, which every bundler tree-shakes;
// these are the functions that they use, over any kind of array.

/** What a function writes into, and returns. It may be one of the arguments. */
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
  /** Through a column-major 4 × 4 matrix, as a point. */
  export function transformMat4(out: Triple, point: V, m: V): Triple;
  /** Rotated by the unit quaternion xyzw. */
  export function transformQuat(out: Triple, a: V, rotation: V): Triple;
  export function normalize(out: Triple, a: V): Triple;
  export function distance(a: V, b: V): number;
  export function dot(a: V, b: V): number;
}

declare module 'gl-matrix/esm/mat3.js' {
  type M = ArrayLike<number>;
  export function determinant(m: M): number;
  /** The transpose of the cofactors. */
  export function adjoint<Out extends GlMatrixOut>(out: Out, m: M): Out;
  export function transpose<Out extends GlMatrixOut>(out: Out, m: M): Out;
  /** The rotation of the unit quaternion xyzw. */
  export function fromQuat<Out extends GlMatrixOut>(out: Out, rotation: M): Out;
  /** The upper left 3 × 3 of a 4 × 4 matrix. */
  export function fromMat4<Out extends GlMatrixOut>(out: Out, m: M): Out;
}

declare module 'gl-matrix/esm/mat4.js' {
  type M = ArrayLike<number>;
  /** a · b: b first, then a. */
  export function multiply<Out extends GlMatrixOut>(out: Out, a: M, b: M): Out;
  /** `null` where the matrix has no inverse. */
  export function invert<Out extends GlMatrixOut>(out: Out, m: M): Out | null;
  /** By radians about an axis; `null` for an axis of length 0. */
  export function fromRotation<Out extends GlMatrixOut>(out: Out, angle: number, axis: M): Out | null;
  /** Scaled, then rotated by the unit quaternion xyzw, then translated. */
  export function fromRotationTranslationScale<Out extends GlMatrixOut>(
    out: Out,
    rotation: M,
    translation: M,
    scale: M,
  ): Out;
  export function fromTranslation<Out extends GlMatrixOut>(out: Out, translation: M): Out;
  /** `m`, applied to what is first rotated about an axis by an angle in radians, scaled or translated. */
  export function rotateX<Out extends GlMatrixOut>(out: Out, m: Out, radians: number): Out;
  export function rotateY<Out extends GlMatrixOut>(out: Out, m: Out, radians: number): Out;
  export function rotateZ<Out extends GlMatrixOut>(out: Out, m: Out, radians: number): Out;
  export function scale<Out extends GlMatrixOut>(out: Out, m: Out, factors: M): Out;
  export function translate<Out extends GlMatrixOut>(out: Out, m: Out, by: M): Out;
}

declare module 'gl-matrix/esm/quat.js' {
  type Q = ArrayLike<number>;
  type Quaternion = [number, number, number, number];
  /** Degrees. @param order `zyx`: first about X, then Y, then Z. */
  export function fromEuler(out: Quaternion, x: number, y: number, z: number, order: 'zyx'): Quaternion;
  /** Radians about a unit axis. */
  export function setAxisAngle(out: Quaternion, axis: Q, angle: number): Quaternion;
  /** Of a rotation as a column-major 3 × 3 matrix. */
  export function fromMat3(out: Quaternion, m: Q): Quaternion;
  /** a · b: b first, then a. */
  export function multiply(out: Quaternion, a: Q, b: Q): Quaternion;
}

export { blasSteps, buildBlas, packTriangles, type Blas, type BlasOptions } from './blas';
export type { TriangleMesh } from './layout';
export type { BuildSettings, TreeBuilder } from './builders/builder';
export {
  anyHit,
  anyHitInstances,
  closestHit,
  closestHitInstances,
  type BlasMesh,
  type Hit,
  type InstanceHit,
  type Ray,
} from './cpu/queries';
export { BvhError } from './error';
export { BLAS_MAX_DEPTH, TLAS_MAX_DEPTH, type Aabb } from './layout';
export { buildTlas, type Tlas } from './tlas';
export type { TlasInstance } from './place-instance';

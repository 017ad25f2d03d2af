export { blasSteps, buildBlas, packTriangles, type Blas, type BlasOptions, type TriangleMesh } from './blas';
export type { BuildSettings, TreeBuilder } from './build/builder';
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
export { buildTlas, type Tlas, type TlasInstance } from './tlas';

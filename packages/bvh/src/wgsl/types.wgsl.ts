import { wgslModule } from '@glanz/wgsl/module';
import { bvhInstanceStruct, bvhNodeStruct } from './structs';

/** What is the same in all layouts: `BvhInstance`, `BvhTriangle`, `BvhHit` and the constant `BVH_MISS`. */
export const bvhRecords = wgslModule(
  'bvh/records',
  /* wgsl */ `
struct BvhTriangle {
  v0: vec3f,
  // Index of the triangle in its mesh.
  id: u32,
  v1: vec3f,
  v2: vec3f,
}

struct BvhHit {
  // In units of the ray's direction.
  t: f32,
  // Barycentrics: the point is (1 - u - v) v0 + u v1 + v v2.
  u: f32,
  v: f32,
  // As the host's bvh_triangle() counts them.
  triangle: u32,
  // As the host's bvh_instance() counts them; BVH_MISS if there is no hit.
  instance: u32,
}

const BVH_MISS = 0xffffffffu;
`,
  [bvhInstanceStruct.module],
);

/** The structs of the traversal: `BvhNode`, `BvhInstance`, `BvhTriangle`, `BvhHit` and the constant `BVH_MISS`. */
export const bvhTypes = wgslModule('bvh/types', '', [bvhNodeStruct.module, bvhRecords]);

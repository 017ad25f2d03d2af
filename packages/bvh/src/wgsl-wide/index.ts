export { bvhBuffers, type BvhBindings } from '../wgsl/buffers.wgsl';
export { bvhOffset } from '../wgsl/modules';
export { packHierarchy, type HierarchyPart, type PackedHierarchy } from '../wgsl/pack';
export { bvhInstanceStruct } from '../wgsl/structs';
export { WIDE_STACK_SIZE as BVH_STACK_SIZE } from '../wide/layout';
export { bvhNodeStruct } from './structs';
export { bvhAnyHit, bvhClosestHit, bvhTraversal, bvhTypes } from './traversal.wgsl';

export { bvhBuffers, type BvhBindings } from '../buffers';
export { bvhOffset } from '../modules';
export { packHierarchy, type HierarchyPart, type PackedHierarchy } from '../pack';
export { bvhInstanceStruct } from '../structs';
export { WIDE_STACK_SIZE as BVH_STACK_SIZE } from '../../wide/layout';
export { bvhNodeStruct } from './structs';
export { bvhAnyHit, bvhClosestHit, bvhTraversal } from './traversal';
export { bvhTypes } from './types';

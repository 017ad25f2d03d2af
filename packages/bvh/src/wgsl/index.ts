export { BVH_STACK_SIZE } from '../layout';
export { bvhBuffers, type BvhBindings } from './buffers';
export { bvhOffset } from './modules';
export { packHierarchy, type HierarchyPart, type PackedHierarchy } from './pack';
export { bvhInstanceStruct, bvhNodeStruct } from './structs';
export { bvhAnyHit, bvhClosestHit, bvhTraversal } from './traversal';
export { bvhTypes } from './types';

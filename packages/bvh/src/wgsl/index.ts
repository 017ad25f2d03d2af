export { BVH_STACK_SIZE } from '../layout';
export { bvhOffset } from './offset.wgsl';
export { bvhInstanceStruct, bvhNodeStruct } from './structs';
export { bvhAnyHit, bvhClosestHit } from './traversal.wgsl';
export { bvhTypes } from './types.wgsl';

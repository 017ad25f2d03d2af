export { bvhInstanceStruct, bvhNodeStruct, BVH_STACK_SIZE } from '../layout';
export { bvhOffset } from './offset.wgsl';
export { bvhAnyHit, bvhClosestHit } from './traversal.wgsl';
export { bvhTypes } from './types.wgsl';

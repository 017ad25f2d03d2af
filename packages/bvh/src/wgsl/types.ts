import { wgslModule } from '@glanz/wgsl/module';
import records from './records.wesl';
import { BvhInstance, bvhNodeStruct } from './structs';

/** The structs of the traversal: `BvhNode`, `BvhInstance`, `BvhTriangle`, `BvhHit` and the constant `BVH_MISS`. */
export const bvhTypes = wgslModule('bvh/types', '', [bvhNodeStruct.module, BvhInstance, records]);

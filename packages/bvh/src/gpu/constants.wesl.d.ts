import type { WgslModule } from '@glanz/wgsl';

/** Threads of a workgroup, and clusters of a block. */
export const BVH_GPU_BLOCK: number;
/** Clusters that a block leaves to the next level. */
export const BVH_GPU_KEPT: number;
/** Drafts of a block that leaves more than one cluster: at least 33 of 256 are left. */
export const BVH_GPU_BLOCK_DRAFTS: number;
/** Up to so many tiles, one workgroup adds up the digits of all. */
export const BVH_GPU_FEW_TILES: number;
/** Words of heads before those of the blocks: the root's record. */
export const BVH_GPU_ROOT_WORDS: number;
/** Keys of a tile of the sort. */
export const BVH_GPU_TILE: number;

declare const module: WgslModule;
export default module;

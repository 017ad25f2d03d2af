import { BvhError } from '../error';
import { MAX_PRIMITIVES } from '../layout';
import {
  BVH_GPU_BLOCK as BLOCK,
  BVH_GPU_BLOCK_DRAFTS as BLOCK_DRAFTS,
  BVH_GPU_KEPT as KEPT,
  BVH_GPU_ROOT_WORDS as ROOT_WORDS,
  BVH_GPU_TILE as TILE,
} from './constants.wesl';

/** Bytes of the words that kernels share. */
export const GLOBALS_BYTES = 128;

/** A level of clustering. */
export interface Level {
  readonly blocks: number;
  readonly firstDraft: number;
  readonly firstHead: number;
}

/** Buffers that only a build needs. */
export type ScratchName =
  | 'globals'
  | 'primitives'
  | 'keys A'
  | 'keys B'
  | 'values A'
  | 'values B'
  | 'digits'
  | 'lowest drafts'
  | 'drafts'
  | 'places'
  | 'heads'
  | 'clusters A'
  | 'clusters B'
  | 'nodes'
  | 'order';

/** What a build of a size needs. */
export interface BuildPlan {
  readonly count: number;
  readonly tiles: number;
  readonly levels: readonly Level[];
  /** Bytes. */
  readonly sizes: Readonly<Record<ScratchName, number>>;
}

/** Total bytes. */
export const planBytes = ({ sizes }: BuildPlan): number => Object.values(sizes).reduce((sum, size) => sum + size, 0);

/** Plans for at most so many primitives. */
export function planBuild(count: number): BuildPlan {
  const levels: Level[] = [];
  let firstDraft = 0,
    firstHead = 0;
  for (let width = BLOCK; ; width *= BLOCK / KEPT) {
    const blocks = Math.max(1, Math.ceil(count / width));
    levels.push({ blocks, firstDraft, firstHead });
    // Where fewer primitives are found than planned for, this may be the last level, with one block.
    firstDraft += Math.max(BLOCK_DRAFTS * blocks, BLOCK);
    firstHead += blocks;
    if (blocks === 1) break;
  }
  const tiles = Math.max(1, Math.ceil(count / TILE));
  const upper = levels[1]?.firstDraft ?? firstDraft;
  const words = 4 * Math.max(1, count);
  const clusters = (level: number) => 48 * KEPT * (levels[level]?.blocks ?? 1);
  return {
    count,
    tiles,
    levels,
    sizes: {
      globals: GLOBALS_BYTES,
      primitives: 8 * words,
      'keys A': words,
      'keys B': words,
      'values A': words,
      'values B': words,
      digits: 4 * 256 * (tiles + 1),
      'lowest drafts': 64 * upper,
      drafts: 64 * Math.max(1, firstDraft - upper),
      places: 16 * firstDraft,
      heads: 4 * (ROOT_WORDS + firstHead),
      'clusters A': clusters(0),
      'clusters B': clusters(1),
      nodes: 16 * words,
      order: words,
    },
  };
}

/**
 * Checks a plan against what the device can bind, before anything is allocated.
 *
 * @param others Bytes of the buffers given, by name.
 * @throws {BvhError} `bvh/too-many`, `bvh/limit`.
 */
export function checkPlan(device: GPUDevice, plan: BuildPlan, what: string, others: Record<string, number>): void {
  const { count, sizes } = plan;
  if (count > MAX_PRIMITIVES)
    throw new BvhError('bvh/too-many', `${count} ${what} are too many; one hierarchy holds ${MAX_PRIMITIVES}.`);
  const { maxStorageBufferBindingSize, maxBufferSize } = device.limits;
  const limit = Math.min(maxStorageBufferBindingSize, maxBufferSize);
  const [name, bytes] = Object.entries({ ...sizes, ...others }).reduce((a, b) => (b[1] > a[1] ? b : a));
  if (bytes > limit)
    throw new BvhError(
      'bvh/limit',
      `A build over ${count} ${what} binds ${bytes} bytes ("${name}"), and the device allows ${limit} (maxStorageBufferBindingSize ${maxStorageBufferBindingSize}, maxBufferSize ${maxBufferSize}): request higher limits, split the mesh, or build on the CPU.`,
    );
}

/**
 * Bytes of temporary GPU memory that a build over `count` triangles or boxes allocates: about 225 each. The largest
 * binding has 64 each, so that a device with WebGPU's default limits builds over 2 million.
 */
export const gpuBuildMemory = (count: number): number => planBytes(planBuild(count));

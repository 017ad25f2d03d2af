import type { WgslModule } from '@glanz/wgsl/module';
import type { Layer } from '../network';
import type { PackedWeights } from '../pack-weights';

/**
 * How threads share a convolution: a thread computes 4 pixels along x in `rows` rows, of `outputs` output channels; a
 * workgroup has `threadsX` × `threadsY` threads over pixels, several times for further outputs.
 */
export interface KernelFamily {
  readonly threadsX: number;
  /** Even. */
  readonly threadsY: number;
  /** Rows of pixels a thread; even where a layer is pooled. */
  readonly rows: number;
  /** Output channels a thread, a multiple of 4. */
  readonly outputs: number;
  /** Where threads read weights from: staged in workgroup memory (the default), or the buffer itself. */
  readonly weights?: 'workgroup' | 'storage';
  /** Largest number of groups of threads for different output channels of the same pixels. Default 8. */
  readonly maxGroups?: number;
}

/** A family with the number of groups that suits a layer. */
export interface ThreadShape extends KernelFamily {
  /** Groups of threads that compute other output channels of the same pixels. */
  readonly groups: number;
}

/** Sizes of the matrices that a device multiplies: `m` × `k` times `k` × `n`. Multiples of 4. */
export interface MatrixSize {
  /** Pixels of a row. */
  readonly m: number;
  /** Output channels. */
  readonly n: number;
  /** Input channels. */
  readonly k: number;
}

/** Shaders of convolutions by subgroup matrices, and their weights. */
export interface MatrixCode {
  convolution(kernel: MatrixConvolution): WgslModule;
  pack(layer: Layer, multiple: number, matrix: MatrixSize): PackedWeights;
}

/** What the shader of a convolution by subgroup matrices depends on. */
export interface MatrixConvolution {
  readonly shape: MatrixShape;
  /** Whether the maximum of 2×2 pixels is stored. */
  readonly pool: boolean;
}

/** Matrices that a device multiplies, and the threads that do so together. */
export interface DeviceMatrices {
  readonly matrix: MatrixSize;
  readonly lanes: number;
  /** The shape for a layer; `undefined` where there are too few output channels to fill a matrix. */
  shapeOf(layer: Layer): MatrixShape | undefined;
}

/**
 * How subgroups share a convolution by matrices: a subgroup computes `m` pixels along x in `rows` rows, of
 * `n` output channels. Where a source is upsampled, `m` and `rows` count pixels of the small image, and the
 * four pixels of the result that lie in each are computed together.
 */
export interface MatrixShape {
  readonly matrix: MatrixSize;
  /** What makes its shader and packs its weights: a module that only devices with matrices load. */
  readonly code: MatrixCode;
  /** Threads of a subgroup. */
  readonly lanes: number;
  /** Rows of pixels a subgroup; even where a layer is pooled. */
  readonly rows: number;
  /** Subgroups of a workgroup, which compute other output channels of the same pixels. */
  readonly subgroups: number;
  /** Halves from a pixel to the next in workgroup memory, a multiple of 8: more than `k` spreads rows over banks. */
  readonly pixelStride: number;
  /** Whether the layer has an upsampled source. */
  readonly up: boolean;
}

/** How a layer is shared: among threads, or among subgroups that multiply matrices. */
export type KernelShape = ThreadShape | MatrixShape;

/** Whether a layer is computed by subgroup matrices. */
export const hasMatrices = (shape: KernelShape): shape is MatrixShape => 'matrix' in shape;

/** Halves of workgroup memory in which pixels are staged. */
export const matrixPatch = (shape: MatrixShape): number =>
  (tileWidth(shape) + 2) * (tileHeight(shape) + 2) * shape.pixelStride;

/** Vectors of workgroup memory in which a subgroup's sums are passed on; one more a row spreads them over banks. */
export const matrixSums = ({ matrix: { m, n } }: MatrixShape): number => m * (n / 4 + 1);

/** Bytes of workgroup memory. */
export const matrixBytes = (shape: MatrixShape): number =>
  2 * matrixPatch(shape) + 16 * shape.subgroups * matrixSums(shape);

/** Whether threads read weights from workgroup memory. */
export const stagesWeights = ({ weights }: KernelFamily): boolean => weights !== 'storage';

/** Bytes of workgroup memory that every device has. */
const WORKGROUP_BYTES = 16384;

/** Pixels of a workgroup along x. */
export const tileWidth = (shape: KernelShape): number =>
  hasMatrices(shape) ? (shape.up ? 2 : 1) * shape.matrix.m : 4 * shape.threadsX;

/** Pixels of a workgroup along y. */
export const tileHeight = (shape: KernelShape): number =>
  hasMatrices(shape) ? shape.rows * (shape.up ? 2 : 1) : shape.threadsY * shape.rows;

/** Output channels of a workgroup. */
export const tileOutputs = (shape: KernelShape): number =>
  hasMatrices(shape) ? shape.subgroups * shape.matrix.n : shape.groups * shape.outputs;

/** Threads of a workgroup. */
export const threadsOf = (shape: KernelShape): number =>
  hasMatrices(shape) ? shape.lanes * shape.subgroups : shape.threadsX * shape.threadsY * shape.groups;

/**
 * Channels of an upsampled source whose weights are staged at a time: 4, 2 or 1, so that it fits; 0 where even one does
 * not, or where there are more threads than every device allows.
 *
 * @param up Whether the layer has an upsampled source.
 */
export function stagedUpChannels(shape: ThreadShape, up: boolean): number {
  if (threadsOf(shape) > 256) return 0;
  const patch = 4 * (tileHeight(shape) + 2) * (shape.threadsX + 1);
  const staged = stagesWeights(shape) ? (shape.groups * shape.outputs) / 4 : 0;
  for (const channels of [4, 2, 1])
    if ((patch + 36 * staged + (up ? channels * 16 * staged : 0)) * 16 <= WORKGROUP_BYTES) return channels;
  return 0;
}

/** The shape as text, for names of pipelines and reports. */
export function shapeName(shape: KernelShape): string {
  if (!hasMatrices(shape))
    return `${shape.threadsX}x${shape.threadsY}x${shape.groups} threads of 4x${shape.rows}x${shape.outputs}${stagesWeights(shape) ? '' : ', weights unstaged'}`;
  const { matrix, rows, subgroups } = shape;
  return `${subgroups} subgroups of ${rows} rows of matrices ${matrix.m}x${matrix.n}x${matrix.k}`;
}

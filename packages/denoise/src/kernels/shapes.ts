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
export interface KernelShape extends KernelFamily {
  /** Groups of threads that compute other output channels of the same pixels. */
  readonly groups: number;
}

/** Whether threads read weights from workgroup memory. */
export const stagesWeights = ({ weights }: KernelFamily): boolean => weights !== 'storage';

/** Bytes of workgroup memory that every device has. */
const WORKGROUP_BYTES = 16384;

/** Pixels of a workgroup along x. */
export const tileWidth = (shape: KernelShape): number => 4 * shape.threadsX;

/** Pixels of a workgroup along y. */
export const tileHeight = (shape: KernelShape): number => shape.threadsY * shape.rows;

/** Output channels of a workgroup. */
export const tileOutputs = (shape: KernelShape): number => shape.groups * shape.outputs;

/** Threads of a workgroup. */
export const threadsOf = (shape: KernelShape): number => shape.threadsX * shape.threadsY * shape.groups;

/**
 * Channels of an upsampled source whose weights are staged at a time: 4, 2 or 1, so that it fits; 0 where even one does
 * not, or where there are more threads than every device allows.
 *
 * @param up Whether the layer has an upsampled source.
 */
export function stagedUpChannels(shape: KernelShape, up: boolean): number {
  if (threadsOf(shape) > 256) return 0;
  const patch = 4 * (tileHeight(shape) + 2) * (shape.threadsX + 1);
  const staged = stagesWeights(shape) ? (shape.groups * shape.outputs) / 4 : 0;
  for (const channels of [4, 2, 1])
    if ((patch + 36 * staged + (up ? channels * 16 * staged : 0)) * 16 <= WORKGROUP_BYTES) return channels;
  return 0;
}

/** The shape as text, for names of pipelines and reports. */
export const shapeName = (shape: KernelShape): string =>
  `${shape.threadsX}x${shape.threadsY}x${shape.groups} threads of 4x${shape.rows}x${shape.outputs}${stagesWeights(shape) ? '' : ', weights unstaged'}`;

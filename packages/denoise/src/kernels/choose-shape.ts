import type { Layer } from '../network';
import { stagedUpChannels, tileHeight, tileOutputs, tileWidth, type KernelFamily, type KernelShape } from './shapes';

/**
 * From the most arithmetic per value read to the most workgroups. 4 × 4 pixels of 8 channels use each weight 16 times and
 * each pixel 72 times, with 128 sums in registers.
 */
const FAMILIES: readonly KernelFamily[] = [
  { threadsX: 8, threadsY: 4, rows: 4, outputs: 8 },
  { threadsX: 4, threadsY: 4, rows: 2, outputs: 8 },
  { threadsX: 2, threadsY: 4, rows: 2, outputs: 4 },
];

/** With an upsampled source there are more weights to stage, and the tile is smaller. */
const FAMILIES_UP: readonly KernelFamily[] = [{ threadsX: 8, threadsY: 2, rows: 4, outputs: 8 }, ...FAMILIES.slice(1)];

/** The last layer has three channels. */
const FAMILY_LAST: KernelFamily = { threadsX: 8, threadsY: 8, rows: 2, outputs: 4 };

/**
 * On CPUs registers are few and workgroups are loops: small sums, and few threads that wait for each other.
 */
const FAMILY_SOFTWARE: KernelFamily = { threadsX: 4, threadsY: 2, rows: 2, outputs: 4 };

/** GPUs of the largest kind have some 130 to 150 processors; each should get a workgroup or two. */
const ENOUGH_WORKGROUPS = 256;

/**
 * The number of groups that computes the fewest channels in vain; the largest of those. `undefined` where a workgroup would
 * have too many threads or too much memory.
 */
export function withGroups(family: KernelFamily, channels: number, up: boolean): KernelShape | undefined {
  let best: KernelShape | undefined;
  let least = Infinity;
  for (let groups = 1; groups <= (family.maxGroups ?? 8); groups++) {
    const shape: KernelShape = { ...family, groups };
    if (stagedUpChannels(shape, up) === 0 || groups * family.outputs >= channels + family.outputs) break;
    const computed = Math.ceil(channels / tileOutputs(shape)) * tileOutputs(shape);
    if (computed > least) continue;
    best = shape;
    least = computed;
  }
  return best;
}

/**
 * The shape for a layer of `width` × `height` pixels: the first of a list that gives enough workgroups.
 *
 * @param software Whether a CPU computes.
 */
export function chooseShape(layer: Layer, width: number, height: number, software: boolean): KernelShape {
  const up = layer.up !== undefined;
  if (software) return withGroups(FAMILY_SOFTWARE, layer.channels, up)!;
  if (layer.channels <= 4) return withGroups(FAMILY_LAST, layer.channels, up)!;
  const shapes = (up ? FAMILIES_UP : FAMILIES).map((family) => withGroups(family, layer.channels, up)!);
  const workgroups = (shape: KernelShape) =>
    Math.ceil(width / tileWidth(shape)) *
    Math.ceil(height / tileHeight(shape)) *
    Math.ceil(layer.channels / tileOutputs(shape));
  return shapes.find((shape) => workgroups(shape) >= ENOUGH_WORKGROUPS) ?? shapes.at(-1)!;
}

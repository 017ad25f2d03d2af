import type { Layer } from '../network';
import {
  shapeName,
  stagedUpChannels,
  threadsOf,
  tileHeight,
  tileOutputs,
  tileWidth,
  type KernelFamily,
  type KernelShape,
} from './shapes';

/**
 * What is chosen from, with the share of the arithmetic peak that it reaches where there is enough to do, in relation to
 * the first (measured on an H200 at 1920 × 1080). More sums a thread mean fewer reads, but fewer threads at a time.
 */
export const FAMILIES: readonly (readonly [family: KernelFamily, efficiency: number])[] = [
  [{ threadsX: 8, threadsY: 8, rows: 2, outputs: 8, maxGroups: 4 }, 1],
  [{ threadsX: 8, threadsY: 8, rows: 2, outputs: 8, maxGroups: 2 }, 0.95],
  [{ threadsX: 16, threadsY: 4, rows: 2, outputs: 8, maxGroups: 4 }, 1],
  [{ threadsX: 8, threadsY: 4, rows: 2, outputs: 8 }, 0.97],
  [{ threadsX: 8, threadsY: 4, rows: 4, outputs: 4 }, 0.97],
  [{ threadsX: 4, threadsY: 4, rows: 2, outputs: 8 }, 0.8],
  [{ threadsX: 4, threadsY: 8, rows: 2, outputs: 4 }, 0.8],
  [{ threadsX: 2, threadsY: 4, rows: 2, outputs: 4 }, 0.6],
  [{ threadsX: 4, threadsY: 8, rows: 1, outputs: 4 }, 0.6],
  [{ threadsX: 2, threadsY: 8, rows: 1, outputs: 4, maxGroups: 4 }, 0.5],
];

/** What is measured first: what was the best of 21 families for some layer on an H100, by up to 6 %. */
const TRIALS: readonly KernelFamily[] = [
  { threadsX: 4, threadsY: 8, rows: 2, outputs: 4 },
  { threadsX: 16, threadsY: 4, rows: 2, outputs: 8, maxGroups: 4 },
  { threadsX: 8, threadsY: 4, rows: 4, outputs: 4 },
];
const TRIALS_UPSAMPLED: readonly KernelFamily[] = [
  { threadsX: 16, threadsY: 4, rows: 2, outputs: 4 },
  { threadsX: 16, threadsY: 4, rows: 2, outputs: 8, maxGroups: 2 },
  { threadsX: 8, threadsY: 4, rows: 4, outputs: 4, maxGroups: 4 },
];

/** The last layer has three channels. */
const FAMILY_LAST: KernelFamily = { threadsX: 8, threadsY: 8, rows: 2, outputs: 4 };

/**
 * On CPUs registers are few and workgroups are loops: small sums, and few threads that wait for each other.
 */
const FAMILY_SOFTWARE: KernelFamily = { threadsX: 4, threadsY: 2, rows: 2, outputs: 4 };

/** What is measured on CPUs besides; shaders of larger sums take them minutes to compile. */
const TRIALS_SOFTWARE: readonly KernelFamily[] = [
  { threadsX: 2, threadsY: 4, rows: 2, outputs: 4 },
  { threadsX: 4, threadsY: 4, rows: 1, outputs: 4, maxGroups: 2 },
];

/**
 * The number of groups that computes the fewest channels in vain; the largest of those. `undefined` where a workgroup would
 * have too many threads or too much memory, or rows do not come in pairs where pairs are pooled.
 */
export function withGroups(
  family: KernelFamily,
  { channels, up, pool }: Pick<Layer, 'channels' | 'up' | 'pool'>,
): KernelShape | undefined {
  if (pool && family.rows % 2 !== 0) return undefined;
  let best: KernelShape | undefined;
  let min = Infinity;
  for (let groups = 1; groups <= (family.maxGroups ?? 8); groups++) {
    const shape: KernelShape = { ...family, groups };
    if (stagedUpChannels(shape, up !== undefined) === 0 || groups * family.outputs >= channels + family.outputs) break;
    const computed = Math.ceil(channels / tileOutputs(shape)) * tileOutputs(shape);
    if (computed > min) continue;
    best = shape;
    min = computed;
  }
  return best;
}

// A model of a large GPU, from which small ones differ little: where there is enough to do for all processors, only the
// efficiency counts.
const PROCESSORS = 132;
const LANES = 128;
const REGISTERS = 65536;
/** Cycles from an instruction of a thread to its next, at least. */
const LATENCY = 2.5;
/** Cycles in which a workgroup waits for four channels to be staged, where no other hides it. */
const STAGING = 1500;

/** Cycles that a layer would take, by the model. */
function estimate(layer: Layer, shape: KernelShape, efficiency: number, width: number, height: number): number {
  const threads = threadsOf(shape);
  const workgroups =
    Math.ceil(width / tileWidth(shape)) *
    Math.ceil(height / tileHeight(shape)) *
    Math.ceil(layer.channels / tileOutputs(shape));
  const sums = 4 * shape.rows * shape.outputs;
  const atOnce = Math.max(1, Math.floor(Math.min(REGISTERS / (sums + 64), 1536) / threads));
  const quads = Math.ceil(layer.upChannels / 4) + Math.ceil(layer.directChannels / 4);
  const multiplications = sums * (4 * layer.upChannels + 9 * 4 * Math.ceil(layer.directChannels / 4));
  const waves = Math.ceil(workgroups / (PROCESSORS * atOnce));
  const together = Math.min(atOnce, Math.ceil(workgroups / PROCESSORS));
  const compute = multiplications * Math.max(LATENCY, (together * threads) / LANES / efficiency);
  return waves * (compute + (quads * STAGING) / together);
}

/** Shapes of the families for a layer of `width` × `height` pixels, the best by the model first. */
function rank(layer: Layer, width: number, height: number): KernelShape[] {
  const ranked: (readonly [shape: KernelShape, cycles: number])[] = [];
  for (const [family, efficiency] of FAMILIES) {
    const shape = withGroups(family, layer);
    if (shape) ranked.push([shape, estimate(layer, shape, efficiency, width, height)]);
  }
  return ranked.sort(([, a], [, b]) => a - b).map(([shape]) => shape);
}

/**
 * The shape for a layer of `width` × `height` pixels.
 *
 * @param software Whether a CPU computes.
 */
export function chooseShape(layer: Layer, width: number, height: number, software: boolean): KernelShape {
  if (software) return withGroups(FAMILY_SOFTWARE, layer)!;
  if (layer.channels <= 4) return withGroups(FAMILY_LAST, layer)!;
  return rank(layer, width, height)[0]!;
}

/** The shape that {@link chooseShape} chooses, then up to `count` − 1 others that are worth a measurement. */
export function candidateShapes(
  layer: Layer,
  width: number,
  height: number,
  software: boolean,
  count: number,
): KernelShape[] {
  const usual = chooseShape(layer, width, height, software);
  if (!software && layer.channels <= 4) return [usual];
  const trials = software ? TRIALS_SOFTWARE : layer.up === undefined ? TRIALS : TRIALS_UPSAMPLED;
  const others = trials.flatMap((family) => withGroups(family, layer) ?? []);
  const shapes = new Map<string, KernelShape>();
  // None twice.
  for (const shape of [usual, ...others, ...(software ? [] : rank(layer, width, height))])
    if (!shapes.has(shapeName(shape))) shapes.set(shapeName(shape), shape);
  return [...shapes.values()].slice(0, count);
}

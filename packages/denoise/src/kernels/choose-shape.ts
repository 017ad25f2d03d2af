import type { Layer } from '../network';
import {
  shapeName,
  stagedUpChannels,
  threadsOf,
  tileHeight,
  tileOutputs,
  tileWidth,
  type KernelFamily,
  type ThreadShape,
} from './shapes';

/** A family with the share of the arithmetic peak that it reaches where there is enough to do, relative to the first. */
interface Choice {
  readonly family: KernelFamily;
  readonly efficiency: number;
  /** The same for layers with an upsampled source; `undefined`: not for those. */
  readonly upsampled?: number;
}

/**
 * What is chosen from. Efficiencies and the constants of the model below are fitted to times of the layers of the small
 * and the base network at 512 × 512 and 1920 × 1080 on an H100: layers take 0.7 % longer than with the best of 21
 * families for each. More sums a thread mean fewer reads, but fewer threads at a time.
 */
const CHOICES: readonly Choice[] = [
  { family: { threadsX: 8, threadsY: 8, rows: 2, outputs: 8, maxGroups: 4 }, efficiency: 1, upsampled: 0.97 },
  { family: { threadsX: 8, threadsY: 8, rows: 2, outputs: 8, maxGroups: 2 }, efficiency: 0.95, upsampled: 0.95 },
  { family: { threadsX: 16, threadsY: 4, rows: 2, outputs: 8, maxGroups: 4 }, efficiency: 1, upsampled: 1 },
  { family: { threadsX: 16, threadsY: 4, rows: 2, outputs: 8, maxGroups: 2 }, efficiency: 0.95, upsampled: 1 },
  { family: { threadsX: 8, threadsY: 4, rows: 2, outputs: 8 }, efficiency: 0.97, upsampled: 0.97 },
  { family: { threadsX: 8, threadsY: 4, rows: 4, outputs: 4 }, efficiency: 0.97, upsampled: 0.97 },
  { family: { threadsX: 8, threadsY: 8, rows: 2, outputs: 4 }, efficiency: 1, upsampled: 0.97 },
  { family: { threadsX: 16, threadsY: 4, rows: 2, outputs: 4 }, efficiency: 0.97, upsampled: 1.1 },
  { family: { threadsX: 4, threadsY: 4, rows: 2, outputs: 8 }, efficiency: 0.9 },
  { family: { threadsX: 4, threadsY: 8, rows: 2, outputs: 4 }, efficiency: 1.1, upsampled: 0.8 },
  { family: { threadsX: 4, threadsY: 8, rows: 1, outputs: 8 }, efficiency: 0.85 },
  { family: { threadsX: 2, threadsY: 4, rows: 2, outputs: 4 }, efficiency: 0.55, upsampled: 0.6 },
  { family: { threadsX: 4, threadsY: 8, rows: 1, outputs: 4 }, efficiency: 0.6, upsampled: 0.6 },
  { family: { threadsX: 2, threadsY: 8, rows: 1, outputs: 4, maxGroups: 4 }, efficiency: 0.4, upsampled: 0.4 },
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
): ThreadShape | undefined {
  if (pool && family.rows % 2 !== 0) return undefined;
  let best: ThreadShape | undefined;
  let min = Infinity;
  for (let groups = 1; groups <= (family.maxGroups ?? 8); groups++) {
    const shape: ThreadShape = { ...family, groups };
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
const LATENCY = 2;
/** Cycles in which a workgroup waits for four channels to be staged, where no other hides it. */
const STAGING = 500;

/** Cycles that a layer would take, by the model. */
function estimate(layer: Layer, shape: ThreadShape, efficiency: number, width: number, height: number): number {
  const threads = threadsOf(shape);
  const workgroups =
    Math.ceil(width / tileWidth(shape)) *
    Math.ceil(height / tileHeight(shape)) *
    Math.ceil(layer.channels / tileOutputs(shape));
  const sums = 4 * shape.rows * shape.outputs;
  const atOnce = Math.max(1, Math.floor(Math.min(REGISTERS / (sums + 64), 1536) / threads));
  const quads = Math.ceil(layer.upChannels / 4) + Math.ceil(layer.directChannels / 4);
  const multiplications = sums * (4 * layer.upChannels + 9 * layer.directChannels);
  const waves = Math.ceil(workgroups / (PROCESSORS * atOnce));
  const together = Math.min(atOnce, Math.ceil(workgroups / PROCESSORS));
  const compute = multiplications * Math.max(LATENCY, (together * threads) / LANES / efficiency);
  return waves * (compute + (quads * STAGING) / together);
}

/** Shapes of the families for a layer of `width` × `height` pixels, the best by the model first. */
function rank(layer: Layer, width: number, height: number): ThreadShape[] {
  const ranked: (readonly [shape: ThreadShape, cycles: number])[] = [];
  for (const { family, efficiency: plain, upsampled } of CHOICES) {
    const efficiency = layer.up === undefined ? plain : upsampled;
    const shape = withGroups(family, layer);
    if (shape && efficiency !== undefined) ranked.push([shape, estimate(layer, shape, efficiency, width, height)]);
  }
  return ranked.sort(([, a], [, b]) => a - b).map(([shape]) => shape);
}

/**
 * The shape for a layer of `width` × `height` pixels.
 *
 * @param software Whether a CPU computes.
 */
export function chooseShape(layer: Layer, width: number, height: number, software: boolean): ThreadShape {
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
): ThreadShape[] {
  const usual = chooseShape(layer, width, height, software);
  if (!software && layer.channels <= 4) return [usual];
  const others = software
    ? TRIALS_SOFTWARE.flatMap((family) => withGroups(family, layer) ?? [])
    : rank(layer, width, height);
  const shapes = new Map<string, ThreadShape>();
  // None twice.
  for (const shape of [usual, ...others]) if (!shapes.has(shapeName(shape))) shapes.set(shapeName(shape), shape);
  return [...shapes.values()].slice(0, count);
}

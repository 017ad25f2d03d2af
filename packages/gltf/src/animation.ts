import type { Accessors } from './accessors';
import type { GltfAnimation, GltfJson } from './json';

/** A node's pose at a time. */
export interface NodePose {
  translation?: readonly number[];
  /** Unit quaternion, xyzw. */
  rotation?: readonly number[];
  scale?: readonly number[];
  /** Of the morph targets. */
  weights?: readonly number[];
}

/** Between two unit quaternions, the shorter way round; `f` from 0 to 1. */
function slerp(a: readonly number[], b: readonly number[], f: number): number[] {
  let cosine = 0;
  for (let k = 0; k < 4; k++) cosine += (a[k] as number) * (b[k] as number);
  const sign = cosine < 0 ? -1 : 1;
  const angle = Math.acos(Math.min(Math.abs(cosine), 1));
  const sine = Math.sin(angle);
  // Nearly equal: interpolate linearly.
  const [p, q] =
    sine < 1e-6 ? [1 - f, f * sign] : [Math.sin((1 - f) * angle) / sine, (sign * Math.sin(f * angle)) / sine];
  return a.map((x, k) => p * x + q * (b[k] as number));
}

function unit(q: readonly number[]): readonly number[] | undefined {
  const length = Math.hypot(...q);
  return length > 1e-12 && length < Infinity ? q.map((x) => x / length) : undefined;
}

/**
 * The value of a sampler at a time (glTF 2.0, 3.11 and appendix C), clamped to the first and last key.
 */
export function valueAt(
  times: Float32Array,
  values: Float32Array,
  interpolation: string,
  time: number,
  turns: boolean,
): number[] {
  const keys = times.length;
  const parts = interpolation === 'CUBICSPLINE' ? 3 : 1;
  const size = values.length / (keys * parts);
  // Of key `key`: 0 the value, −1 the incoming tangent, 1 the outgoing one.
  const part = (key: number, which: -1 | 0 | 1) => {
    const at = (key * parts + (parts === 3 ? which + 1 : 0)) * size;
    return Array.from(values.subarray(at, at + size));
  };
  let low = 0,
    high = keys - 1;
  if (!(time > (times[0] as number))) return part(0, 0);
  if (time >= (times[high] as number)) return part(high, 0);
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if ((times[middle] as number) <= time) low = middle;
    else high = middle;
  }
  const span = (times[high] as number) - (times[low] as number);
  const f = span > 0 ? (time - (times[low] as number)) / span : 0;
  const a = part(low, 0),
    b = part(high, 0);
  if (interpolation === 'STEP') return a;
  if (parts === 1) return turns ? slerp(a, b, f) : a.map((x, k) => x + f * ((b[k] as number) - x));
  const out = part(low, 1),
    into = part(high, -1);
  const f2 = f * f,
    f3 = f2 * f;
  return a.map(
    (x, k) =>
      (2 * f3 - 3 * f2 + 1) * x +
      span * (f3 - 2 * f2 + f) * (out[k] as number) +
      (3 * f2 - 2 * f3) * (b[k] as number) +
      span * (f3 - f2) * (into[k] as number),
  );
}

/**
 * Poses of the nodes at a time. Values that are not finite are ignored, with a warning.
 * @param time Seconds from the animation's beginning.
 * @param warn Takes the number of a sampler and what is wrong with it.
 */
export function posesAt(
  { channels, samplers }: GltfAnimation,
  time: number,
  accessors: Pick<Accessors, 'floats'>,
  warn: (sampler: number, what: string) => void,
): Map<number, NodePose> {
  const poses = new Map<number, NodePose>();
  const read = new Map<number, Float32Array>();
  const numbers = (accessor: number) => {
    const known = read.get(accessor) ?? accessors.floats(accessor);
    read.set(accessor, known);
    return known;
  };
  for (const sampler of new Set(channels.map((channel) => channel.sampler))) {
    const times = numbers((samplers[sampler] as (typeof samplers)[number]).input);
    const rise = times.every((at, key) => at >= (key === 0 ? 0 : (times[key - 1] as number)) && at < Infinity);
    if (!rise)
      warn(sampler, 'has times that do not rise from 0 or later; the keys around a time may be the wrong ones');
  }
  for (const { sampler, target } of channels) {
    const { input, output, interpolation } = samplers[sampler] as (typeof samplers)[number];
    const turns = target.path === 'rotation';
    const value = valueAt(numbers(input), numbers(output), interpolation, time, turns);
    const good = turns ? unit(value) : value.every(Number.isFinite) ? value : undefined;
    if (!good) {
      warn(
        sampler,
        `has a value for the ${target.path} of node ${target.node} that is not finite or has no length; it does not count`,
      );
      continue;
    }
    const pose = poses.get(target.node) ?? {};
    pose[target.path as keyof NodePose] = good;
    poses.set(target.node, pose);
  }
  return poses;
}

/** Nodes whose morph weights some animation of a document changes. */
export const morphingNodes = ({ animations = [] }: GltfJson): ReadonlySet<number> =>
  new Set(
    animations.flatMap(({ channels, pointers = [] }) => [
      ...channels.filter(({ target }) => target.path === 'weights').map(({ target }) => target.node),
      ...pointers.filter(({ path }) => path[0] === 'nodes' && path[2] === 'weights').map(({ path }) => Number(path[1])),
    ]),
  );

/** Names of a document's animations, and their durations in seconds as the document declares them. */
export function describeAnimations({
  animations = [],
  accessors = [],
}: GltfJson): { name: string; duration: number }[] {
  return animations.map(({ name, samplers }, index) => {
    const ends = samplers.map(
      ({ input }) => ((accessors[input] as { max?: unknown } | undefined)?.max as readonly unknown[] | undefined)?.[0],
    );
    return {
      name: name ?? `animation ${index}`,
      duration: Math.max(0, ...ends.filter((end) => typeof end === 'number' && Number.isFinite(end)).map(Number)),
    };
  });
}

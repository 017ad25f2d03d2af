/**
 * A binary tree over lights, to pick those that matter at a place: Conty Estévez and Kulla, "Importance Sampling of Many
 * Lights with Adaptive Tree Splitting" (2018), as pbrt 4 has it, without the splitting. Each node bounds where its lights
 * are and where they shine; a walk from the root goes down one child or the other as much as each may light the place. The
 * chance of any light is then known without a walk through the others, as multiple importance sampling wants it.
 *
 * Built top down by the surface area orientation heuristic over 12 bins along the longest axis. Lights that are infinitely far
 * away hang in a branch of their own below the root; they have a direction and no place.
 */

/** What the tree needs to know of lights. */
export interface TreeLights {
  /** Lowest and highest corner, stride 6. */
  readonly bounds: Float64Array;
  /** Unit vector that it shines along, stride 3. */
  readonly axes: Float64Array;
  /** Largest angle between the axis and a normal, radians: 0 for a flat light, π for one that shines all around. */
  readonly spreads: Float64Array;
  /** Angle from a normal up to which it shines, radians. */
  readonly reaches: Float64Array;
  /** Irradiance at a distance of 1 m, face to face: radiance × area, or radiant intensity. */
  readonly energies: Float64Array;
}

/** Bounds of some lights. */
interface Bounds {
  low: [number, number, number];
  high: [number, number, number];
  axis: [number, number, number];
  spread: number;
  reach: number;
  energy: number;
}

/** A node of the tree. */
export interface LightTreeNode {
  readonly center: readonly [number, number, number];
  /** Of the sphere around its box. */
  readonly radius: number;
  readonly axis: readonly [number, number, number];
  readonly cosSpread: number;
  readonly cosReach: number;
  readonly energy: number;
  /** Its lights are infinitely far away. */
  readonly distant: boolean;
  /** Of a leaf: the light. */
  readonly light?: number;
  /** Of an inner node: the first of two children, which follow each other. */
  readonly child?: number;
}

/** The tree; its root is node 0. */
export interface LightTree {
  readonly nodes: readonly LightTreeNode[];
  /** By light: the way to it from the root, a bit a level from the lowest on; 1 is the second child. */
  readonly trails: Uint32Array;
}

const BINS = 12;

/** A trail has 32 bits. */
const MOST_LEVELS = 32;

function boundsOf(lights: TreeLights, i: number): Bounds {
  const at = (values: Float64Array, k: number) => values[k] as number;
  return {
    low: [at(lights.bounds, 6 * i), at(lights.bounds, 6 * i + 1), at(lights.bounds, 6 * i + 2)],
    high: [at(lights.bounds, 6 * i + 3), at(lights.bounds, 6 * i + 4), at(lights.bounds, 6 * i + 5)],
    axis: [at(lights.axes, 3 * i), at(lights.axes, 3 * i + 1), at(lights.axes, 3 * i + 2)],
    spread: at(lights.spreads, i),
    reach: at(lights.reaches, i),
    energy: at(lights.energies, i),
  };
}

/** The smallest cone around two. */
function unite(a: Bounds, b: Bounds): void {
  for (const k of [0, 1, 2] as const) {
    a.low[k] = Math.min(a.low[k], b.low[k]);
    a.high[k] = Math.max(a.high[k], b.high[k]);
  }
  a.energy += b.energy;
  a.reach = Math.max(a.reach, b.reach);
  const between = Math.acos(Math.min(1, Math.max(-1, a.axis[0] * b.axis[0] + a.axis[1] * b.axis[1] + a.axis[2] * b.axis[2])));
  if (Math.min(between + b.spread, Math.PI) <= a.spread) return;
  if (Math.min(between + a.spread, Math.PI) <= b.spread) {
    a.axis = [...b.axis];
    a.spread = b.spread;
    return;
  }
  const spread = (a.spread + between + b.spread) / 2;
  // From a's axis towards b's: the part of b's across a's, where there is one.
  const across = [0, 1, 2].map((k) => (b.axis[k] as number) - Math.cos(between) * (a.axis[k] as number));
  const length = Math.hypot(...across);
  if (spread >= Math.PI || length < 1e-9) {
    a.spread = Math.PI;
    return;
  }
  const turn = spread - a.spread;
  a.axis = [0, 1, 2].map((k) => Math.cos(turn) * (a.axis[k] as number) + (Math.sin(turn) / length) * (across[k] as number)) as Bounds['axis'];
  a.spread = spread;
}

/** Directions that a cone shines into, weighed by the cosine beyond its spread. */
function solidAngle({ spread, reach }: Bounds): number {
  const all = Math.min(spread + reach, Math.PI);
  return 2 * Math.PI * (1 - Math.cos(spread)) + (Math.PI / 2) * (2 * all * Math.sin(spread) - Math.cos(spread - 2 * all) - 2 * spread * Math.sin(spread) + Math.cos(spread));
}

function cost(bounds: Bounds): number {
  const [x, y, z] = [0, 1, 2].map((k) => (bounds.high[k] as number) - (bounds.low[k] as number)) as [number, number, number];
  return bounds.energy * solidAngle(bounds) * (x * y + y * z + z * x);
}

/**
 * Builds a tree.
 *
 * @param near Indices of the lights that are in it and have a place, each with an energy above 0.
 * @param distant Those infinitely far away; of all there is one at least.
 */
export function buildLightTree(lights: TreeLights, near: readonly number[], distant: readonly number[] = []): LightTree {
  const nodes: LightTreeNode[] = [];
  const trails = new Uint32Array(lights.energies.length);
  const order = Uint32Array.from([...near, ...distant]);
  const center = (i: number, k: number) => (lights.bounds[6 * i + k] as number) + (lights.bounds[6 * i + 3 + k] as number);
  const whole = (from: number, to: number): Bounds => {
    const sum = boundsOf(lights, order[from] as number);
    for (let i = from + 1; i < to; i++) unite(sum, boundsOf(lights, order[i] as number));
    return sum;
  };

  /** Sorts order[from, to) so that a split lies at the index returned. */
  const split = (from: number, to: number, level: number): number => {
    if (from < near.length && to > near.length) return near.length;
    if (from >= near.length) return (from + to) >> 1;
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = from; i < to; i++) {
      for (let k = 0; k < 3; k++) {
        const c = center(order[i] as number, k);
        low[k] = Math.min(low[k] as number, c);
        high[k] = Math.max(high[k] as number, c);
      }
    }
    const extents = low.map((value, k) => (high[k] as number) - value);
    const axis = extents.indexOf(Math.max(...extents));
    const extent = extents[axis] as number;
    const middle = (from + to) >> 1;
    // Halves keep the way to a light within a trail's bits.
    const halves = extent <= 0 || Math.ceil(Math.log2(to - from)) + 1 >= MOST_LEVELS - level;
    if (!halves) {
      const binOf = (i: number) => Math.min(BINS - 1, Math.floor((BINS * (center(i, axis) - (low[axis] as number))) / extent));
      const bins: (Bounds | undefined)[] = new Array(BINS).fill(undefined);
      for (let i = from; i < to; i++) {
        const light = order[i] as number;
        const bin = binOf(light);
        const there = bins[bin];
        if (there) unite(there, boundsOf(lights, light));
        else bins[bin] = boundsOf(lights, light);
      }
      const sweep = (bins: readonly (Bounds | undefined)[]): number[] => {
        let sum: Bounds | undefined;
        return bins.map((bin) => {
          if (bin && sum) unite(sum, bin);
          else if (bin) sum = { ...bin, low: [...bin.low], high: [...bin.high], axis: [...bin.axis] };
          return sum ? cost(sum) : 0;
        });
      };
      const left = sweep(bins);
      const right = sweep([...bins].reverse()).reverse();
      let best = 1;
      let least = Infinity;
      for (let at = 1; at < BINS; at++) {
        const sum = (left[at - 1] as number) + (right[at] as number);
        if (sum < least) [best, least] = [at, sum];
      }
      // Partition in place.
      let end = from;
      for (let i = from; i < to; i++) {
        const light = order[i] as number;
        if (binOf(light) >= best) continue;
        order[i] = order[end] as number;
        order[end++] = light;
      }
      if (end > from && end < to) return end;
    }
    order.subarray(from, to).sort((a, b) => center(a, axis) - center(b, axis) || a - b);
    return middle;
  };

  const write = (at: number, bounds: Bounds, distant: boolean, link: { readonly light: number } | { readonly child: number }): void => {
    const { low, high, axis, spread, reach, energy } = bounds;
    const middle = [0, 1, 2].map((k) => ((low[k] as number) + (high[k] as number)) / 2) as [number, number, number];
    const radius = 0.5 * Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    nodes[at] = { center: middle, radius, axis, cosSpread: Math.cos(spread), cosReach: Math.cos(reach), energy, distant, ...link };
  };

  const build = (at: number, from: number, to: number, level: number, trail: number): void => {
    const bounds = whole(from, to);
    if (to - from === 1) {
      const light = order[from] as number;
      trails[light] = trail;
      write(at, bounds, from >= near.length, { light });
      return;
    }
    const middle = split(from, to, level);
    const child = nodes.length;
    nodes.length += 2;
    write(at, bounds, from >= near.length, { child });
    build(child, from, middle, level + 1, trail);
    build(child + 1, middle, to, level + 1, (trail | (1 << level)) >>> 0);
  };
  nodes.length = 1;
  build(0, 0, order.length, 0, 0);
  return { nodes, trails };
}

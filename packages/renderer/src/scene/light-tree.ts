import type { Steps } from '@glanz/scene';

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

/** Numbers of a node in `LightTree.values`, from its first on. */
export const LIGHT_TREE_NODE = {
  /** Three: the middle of the sphere around its lights. */
  center: 0,
  radius: 3,
  /** Three: a unit vector. */
  axis: 4,
  cosSpread: 7,
  cosReach: 8,
  energy: 9,
  /** How many there are. */
  stride: 10,
} as const;

/** A bit of `LightTree.kinds`: the node is a leaf, of one light. */
export const LIGHT_TREE_LEAF = 1;
/** A bit of `LightTree.kinds`: the node's lights are infinitely far away. */
export const LIGHT_TREE_DISTANT = 2;

/** The tree; its root is node 0. Columns, not objects: see {@link BoundsStore}. */
export interface LightTree {
  /** Nodes. */
  readonly count: number;
  /** By node, as {@link LIGHT_TREE_NODE} says. */
  readonly values: Float64Array;
  /** By node: {@link LIGHT_TREE_LEAF}, {@link LIGHT_TREE_DISTANT}. */
  readonly kinds: Uint8Array;
  /** By node: of a leaf, its light; else the first of two children, which follow each other. */
  readonly links: Uint32Array;
  /** By light: the way to it from the root, a bit a level from the lowest on; 1 is the second child. */
  readonly trails: Uint32Array;
}

const BINS = 12;

/** Lights that are gone through between two stops, once for each level. */
const STEP_LIGHTS = 4096;

/** A trail has 32 bits. */
const MOST_LEVELS = 32;

/** Numbers that bound some lights: lowest and highest corner, axis, then the four below. */
const STRIDE = 13;
const AXIS = 6;
const SPREAD = 9;
const REACH = 10;
const ENERGY = 11;
/** Cosine of the spread. */
const COS = 12;

/** More than rounding moves a cosine. */
const CLEARLY = 1e-9;

/**
 * Bounds of lights and of sets of lights, in one array: the lights' own first, then places for sums. No objects, since every
 * level of the tree goes over all lights twice, in a scene's first moments, when nothing is compiled yet.
 */
class BoundsStore {
  readonly values: Float64Array;

  constructor(lights: TreeLights, sums: number) {
    const count = lights.energies.length;
    const values = (this.values = new Float64Array(STRIDE * (count + sums)));
    for (let i = 0; i < count; i++) {
      for (let k = 0; k < 6; k++) values[STRIDE * i + k] = lights.bounds[6 * i + k] as number;
      for (let k = 0; k < 3; k++) values[STRIDE * i + AXIS + k] = lights.axes[3 * i + k] as number;
      values[STRIDE * i + SPREAD] = lights.spreads[i] as number;
      values[STRIDE * i + REACH] = lights.reaches[i] as number;
      values[STRIDE * i + ENERGY] = lights.energies[i] as number;
      values[STRIDE * i + COS] = Math.cos(lights.spreads[i] as number);
    }
  }

  copy(to: number, from: number): void {
    this.values.copyWithin(STRIDE * to, STRIDE * from, STRIDE * from + STRIDE);
  }

  /** Grows the bounds at `to` by those at `from`: the box around both, and the smallest cone around two. */
  unite(to: number, from: number): void {
    const v = this.values;
    const a = STRIDE * to;
    const b = STRIDE * from;
    if ((v[b] as number) < (v[a] as number)) v[a] = v[b] as number;
    if ((v[b + 1] as number) < (v[a + 1] as number)) v[a + 1] = v[b + 1] as number;
    if ((v[b + 2] as number) < (v[a + 2] as number)) v[a + 2] = v[b + 2] as number;
    if ((v[b + 3] as number) > (v[a + 3] as number)) v[a + 3] = v[b + 3] as number;
    if ((v[b + 4] as number) > (v[a + 4] as number)) v[a + 4] = v[b + 4] as number;
    if ((v[b + 5] as number) > (v[a + 5] as number)) v[a + 5] = v[b + 5] as number;
    v[a + ENERGY] = (v[a + ENERGY] as number) + (v[b + ENERGY] as number);
    if ((v[b + REACH] as number) > (v[a + REACH] as number)) v[a + REACH] = v[b + REACH] as number;
    const spreadA = v[a + SPREAD] as number, spreadB = v[b + SPREAD] as number;
    if (spreadA >= Math.PI) return;
    const ax = v[a + AXIS] as number, ay = v[a + AXIS + 1] as number, az = v[a + AXIS + 2] as number;
    const bx = v[b + AXIS] as number, by = v[b + AXIS + 1] as number, bz = v[b + AXIS + 2] as number;
    const cos = Math.min(1, Math.max(-1, ax * bx + ay * by + az * bz));
    // Most lights are flat, and within the cone of those before them.
    if (spreadB === 0 && cos > (v[a + COS] as number) + CLEARLY) return;
    const between = Math.acos(cos);
    if (Math.min(between + spreadB, Math.PI) <= spreadA) return;
    if (Math.min(between + spreadA, Math.PI) <= spreadB) {
      v.copyWithin(a + AXIS, b + AXIS, b + SPREAD + 1);
      v[a + COS] = v[b + COS] as number;
      return;
    }
    const spread = (spreadA + between + spreadB) / 2;
    // From a's axis towards b's: the part of b's across a's, where there is one.
    const x = bx - cos * ax, y = by - cos * ay, z = bz - cos * az;
    const length = Math.sqrt(x * x + y * y + z * z);
    if (spread >= Math.PI || length < 1e-9) {
      v[a + SPREAD] = Math.PI;
      v[a + COS] = -1;
      return;
    }
    const turn = spread - spreadA;
    const along = Math.cos(turn);
    const aside = Math.sin(turn) / length;
    v[a + AXIS] = along * ax + aside * x;
    v[a + AXIS + 1] = along * ay + aside * y;
    v[a + AXIS + 2] = along * az + aside * z;
    v[a + SPREAD] = spread;
    v[a + COS] = Math.cos(spread);
  }

  /** What it costs to have these lights in one node: energy, times where they are, times where they shine. */
  cost(at: number): number {
    const v = this.values;
    const a = STRIDE * at;
    const x = (v[a + 3] as number) - (v[a] as number);
    const y = (v[a + 4] as number) - (v[a + 1] as number);
    const z = (v[a + 5] as number) - (v[a + 2] as number);
    const spread = v[a + SPREAD] as number;
    const all = Math.min(spread + (v[a + REACH] as number), Math.PI);
    const sin = Math.sin(spread), cos = v[a + COS] as number;
    // Directions that the cone shines into, weighed by the cosine beyond its spread.
    const solidAngle = 2 * Math.PI * (1 - cos) + (Math.PI / 2) * (2 * all * sin - Math.cos(spread - 2 * all) - 2 * spread * sin + cos);
    return (v[a + ENERGY] as number) * solidAngle * (x * y + y * z + z * x);
  }
}

/** Axis that the centres of some lights spread most along, where they begin on it and how far they reach. */
interface Spread {
  readonly axis: number;
  readonly start: number;
  readonly extent: number;
}

/**
 * What a tree is built with. A class, since its methods are the same for every tree: machine code that the engine has made for
 * one scene's serves the next.
 */
class LightTreeBuilder {
  readonly tree: LightTree;
  readonly #order: Uint32Array;
  readonly #firstDistant: number;
  /** Twice the middles of all lights, stride 3. */
  readonly #centers: Float64Array;
  readonly #store: BoundsStore;
  /** Places for sums: one for a node, one that grows in a sweep, and the bins. */
  readonly #node: number;
  readonly #sum: number;
  readonly #firstBin: number;
  readonly #filled = new Uint8Array(BINS);
  readonly #left = new Float64Array(BINS);
  readonly #right = new Float64Array(BINS);
  /** By place in the order, while a node is split. */
  readonly #bins: Uint8Array;
  /** Node, range of the order, level and trail of each that waits to be made: one a level, and one more. */
  readonly #waiting = new Uint32Array(5 * (MOST_LEVELS + 2));
  #made = 1;

  constructor(lights: TreeLights, near: ArrayLike<number>, distant: ArrayLike<number>) {
    const count = lights.energies.length;
    this.#firstDistant = near.length;
    this.#order = new Uint32Array(near.length + distant.length);
    this.#order.set(near);
    this.#order.set(distant, near.length);
    const nodes = 2 * this.#order.length - 1;
    this.tree = { count: nodes, values: new Float64Array(LIGHT_TREE_NODE.stride * nodes), kinds: new Uint8Array(nodes), links: new Uint32Array(nodes), trails: new Uint32Array(count) };
    this.#centers = new Float64Array(3 * count);
    for (let i = 0; i < count; i++) for (let k = 0; k < 3; k++) this.#centers[3 * i + k] = (lights.bounds[6 * i + k] as number) + (lights.bounds[6 * i + 3 + k] as number);
    this.#store = new BoundsStore(lights, 2 + BINS);
    [this.#node, this.#sum, this.#firstBin] = [count, count + 1, count + 2];
    this.#bins = new Uint8Array(this.#order.length);
  }

  /** Makes all nodes. */
  *steps(): Steps<LightTree> {
    const waiting = this.#waiting;
    let work = 0;
    // The last first: left comes before right.
    for (let top = this.#wait(0, 0, 0, this.#order.length, 0, 0); top > 0; ) {
      top -= 5;
      const node = waiting[top] as number, from = waiting[top + 1] as number, to = waiting[top + 2] as number, level = waiting[top + 3] as number, trail = waiting[top + 4] as number;
      const middle = this.#makeNode(node, from, to, level, trail);
      if (middle > from) {
        const child = this.tree.links[node] as number;
        top = this.#wait(top, child + 1, middle, to, level + 1, trail | (1 << level));
        top = this.#wait(top, child, from, middle, level + 1, trail);
      }
      work += to - from;
      if (work < STEP_LIGHTS) continue;
      work = 0;
      yield;
    }
    return this.tree;
  }

  #wait(top: number, node: number, from: number, to: number, level: number, trail: number): number {
    const waiting = this.#waiting;
    waiting[top] = node;
    waiting[top + 1] = from;
    waiting[top + 2] = to;
    waiting[top + 3] = level;
    waiting[top + 4] = trail;
    return top + 5;
  }

  /** Makes one node; where its second child begins in the order, or `from` for a leaf. */
  #makeNode(node: number, from: number, to: number, level: number, trail: number): number {
    this.#whole(from, to);
    this.#write(node);
    const { kinds, links, trails } = this.tree;
    kinds[node] = (to - from === 1 ? LIGHT_TREE_LEAF : 0) | (from >= this.#firstDistant ? LIGHT_TREE_DISTANT : 0);
    if (to - from === 1) {
      const light = this.#order[from] as number;
      links[node] = light;
      trails[light] = trail;
      return from;
    }
    links[node] = this.#made;
    this.#made += 2;
    return this.#split(from, to, level);
  }

  #whole(from: number, to: number): void {
    this.#store.copy(this.#node, this.#order[from] as number);
    for (let i = from + 1; i < to; i++) this.#store.unite(this.#node, this.#order[i] as number);
  }

  /** Makes a node of the sum at #node. */
  #write(node: number): void {
    const v = this.#store.values, n = STRIDE * this.#node, { values } = this.tree, at = LIGHT_TREE_NODE.stride * node;
    for (let k = 0; k < 3; k++) {
      values[at + LIGHT_TREE_NODE.center + k] = ((v[n + k] as number) + (v[n + 3 + k] as number)) / 2;
      values[at + LIGHT_TREE_NODE.axis + k] = v[n + AXIS + k] as number;
    }
    values[at + LIGHT_TREE_NODE.radius] = 0.5 * Math.hypot((v[n + 3] as number) - (v[n] as number), (v[n + 4] as number) - (v[n + 1] as number), (v[n + 5] as number) - (v[n + 2] as number));
    values[at + LIGHT_TREE_NODE.cosSpread] = Math.cos(v[n + SPREAD] as number);
    values[at + LIGHT_TREE_NODE.cosReach] = Math.cos(v[n + REACH] as number);
    values[at + LIGHT_TREE_NODE.energy] = v[n + ENERGY] as number;
  }

  /** Sorts order[from, to) so that a split lies at the index returned. */
  #split(from: number, to: number, level: number): number {
    if (from < this.#firstDistant && to > this.#firstDistant) return this.#firstDistant;
    const middle = (from + to) >> 1;
    if (from >= this.#firstDistant) return middle;
    const spread = this.#widest(from, to);
    // Halves keep the way to a light within a trail's bits.
    const halves = spread.extent <= 0 || Math.ceil(Math.log2(to - from)) + 1 >= MOST_LEVELS - level;
    if (!halves) {
      const end = this.#partition(from, to, this.#bin(from, to, spread));
      if (end > from && end < to) return end;
    }
    const centers = this.#centers;
    const { axis } = spread;
    this.#order.subarray(from, to).sort((a, b) => (centers[3 * a + axis] as number) - (centers[3 * b + axis] as number) || a - b);
    return middle;
  }

  #widest(from: number, to: number): Spread {
    const order = this.#order, centers = this.#centers;
    let axis = 0, start = 0, extent = -Infinity;
    for (let k = 0; k < 3; k++) {
      let low = Infinity, high = -Infinity;
      for (let i = from; i < to; i++) {
        const c = centers[3 * (order[i] as number) + k] as number;
        if (c < low) low = c;
        if (c > high) high = c;
      }
      if (high - low > extent) {
        axis = k;
        start = low;
        extent = high - low;
      }
    }
    return { axis, start, extent };
  }

  /** Sorts lights into bins; the first bin beyond the best cut. */
  #bin(from: number, to: number, { axis, start, extent }: Spread): number {
    const order = this.#order, centers = this.#centers, bins = this.#bins, filled = this.#filled, store = this.#store;
    for (let i = from; i < to; i++) bins[i] = Math.min(BINS - 1, Math.floor((BINS * ((centers[3 * (order[i] as number) + axis] as number) - start)) / extent));
    // Two lie in the first bin and the last, and every cut is the same.
    if (to - from <= 2) return BINS - 1;
    filled.fill(0);
    for (let i = from; i < to; i++) {
      const bin = bins[i] as number;
      if (filled[bin]) store.unite(this.#firstBin + bin, order[i] as number);
      else store.copy(this.#firstBin + bin, order[i] as number);
      filled[bin] = 1;
    }
    this.#sweep(this.#left, 0, 1);
    this.#sweep(this.#right, BINS - 1, -1);
    let best = 1;
    let least = Infinity;
    for (let at = 1; at < BINS; at++) {
      const sum = (this.#left[at - 1] as number) + (this.#right[at] as number);
      if (sum < least) {
        best = at;
        least = sum;
      }
    }
    return best;
  }

  /** Costs of the bins up to each, in either direction. */
  #sweep(costs: Float64Array, first: number, step: number): void {
    const store = this.#store;
    let any = false;
    let cost = 0;
    for (let n = 0, bin = first; n < BINS; n++, bin += step) {
      if (this.#filled[bin]) {
        if (any) store.unite(this.#sum, this.#firstBin + bin);
        else store.copy(this.#sum, this.#firstBin + bin);
        any = true;
        cost = store.cost(this.#sum);
      }
      costs[bin] = cost;
    }
  }

  /** Brings the lights of the bins before a cut to the front; where the others begin. */
  #partition(from: number, to: number, cut: number): number {
    const order = this.#order, bins = this.#bins;
    let end = from;
    for (let i = from; i < to; i++) {
      if ((bins[i] as number) >= cut) continue;
      const light = order[i] as number;
      order[i] = order[end] as number;
      order[end++] = light;
    }
    return end;
  }
}

/**
 * Builds a tree.
 *
 * @param near Indices of the lights that are in it and have a place, each with an energy above 0.
 * @param distant Those infinitely far away; of all there is one at least.
 */
export function lightTreeSteps(lights: TreeLights, near: ArrayLike<number>, distant: ArrayLike<number> = []): Steps<LightTree> {
  return new LightTreeBuilder(lights, near, distant).steps();
}

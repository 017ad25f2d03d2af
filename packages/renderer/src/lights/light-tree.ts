import type { Steps } from '@glanz/scene';
import { AXIS, BoundsStore, ENERGY, REACH, SPREAD, STRIDE, type TreeLights } from './light-bounds';

/**
 * A binary tree over lights, to pick those that matter at a place: Conty Estévez and Kulla, "Importance Sampling of
 * Many Lights with Adaptive Tree Splitting" (2018), as pbrt 4 has it, without the splitting. Each node bounds where its
 * lights are and where they shine; a walk from the root goes down one child or the other as much as each may light the
 * place. The chance of any light is then known without a walk through the others, as multiple importance sampling wants
 * it.
 *
 * Built top down by the surface area orientation heuristic over 12 bins along the longest axis. Lights that are
 * infinitely far away hang in a branch of their own below the root; they have a direction and no place.
 */

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

/** Lights of a level that are processed between two yields. */
const STEP_LIGHTS = 4096;

/** A trail has 32 bits. */
const MOST_LEVELS = 32;

/**
 * What a tree is built with. A class, since its methods are the same for every tree: machine code that the engine has
 * made for one scene's serves the next.
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
  /** Least and largest centres of a node's lights, and the axis that is split along. */
  readonly #reach = new Float64Array(6);
  #axis = 0;
  #start = 0;
  #extent = 0;
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
    this.tree = {
      count: nodes,
      values: new Float64Array(LIGHT_TREE_NODE.stride * nodes),
      kinds: new Uint8Array(nodes),
      links: new Uint32Array(nodes),
      trails: new Uint32Array(count),
    };
    this.#centers = new Float64Array(3 * count);
    this.#store = new BoundsStore(count, 2 + BINS);
    [this.#node, this.#sum, this.#firstBin] = [count, count + 1, count + 2];
    this.#bins = new Uint8Array(this.#order.length);
  }

  /** Takes in what is known of the lights from one index to another. */
  take(lights: TreeLights, from: number, to: number): void {
    this.#store.take(lights, from, to);
    for (let i = from; i < to; i++)
      for (let k = 0; k < 3; k++)
        this.#centers[3 * i + k] = (lights.bounds[6 * i + k] as number) + (lights.bounds[6 * i + 3 + k] as number);
  }

  /** Makes all nodes. */
  *steps(): Steps<LightTree> {
    const waiting = this.#waiting;
    let work = 0;
    // The last first: left comes before right.
    for (let top = this.#wait(0, 0, 0, this.#order.length, 0, 0); top > 0;) {
      top -= 5;
      const node = waiting[top] as number,
        from = waiting[top + 1] as number,
        to = waiting[top + 2] as number,
        level = waiting[top + 3] as number,
        trail = waiting[top + 4] as number;
      const large = to - from > STEP_LIGHTS;
      if (large) yield* this.#gather(from, to);
      else this.#gatherAll(from, to);
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

  /** Makes one node of what was gathered; where its second child begins in the order, or `from` for a leaf. */
  #makeNode(node: number, from: number, to: number, level: number, trail: number): number {
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

  /** Gathers what a node and its split need to know of order[from, to): the sum of its lights, and their bins. */
  #gatherAll(from: number, to: number): void {
    this.#begin(from);
    this.#add(from + 1, to);
    if (this.#choose(from, to)) this.#fill(from, to, to - from > 2);
  }

  /** The same in pieces, of many lights. */
  *#gather(from: number, to: number): Steps<void> {
    this.#begin(from);
    for (let at = from + 1; at < to; at += STEP_LIGHTS, yield) this.#add(at, Math.min(to, at + STEP_LIGHTS));
    if (this.#choose(from, to))
      for (let at = from; at < to; at += STEP_LIGHTS, yield) this.#fill(at, Math.min(to, at + STEP_LIGHTS), true);
  }

  #begin(from: number): void {
    const light = this.#order[from] as number;
    this.#store.copy(this.#node, light);
    for (let k = 0; k < 3; k++) this.#reach[k] = this.#reach[3 + k] = this.#centers[3 * light + k] as number;
    this.#filled.fill(0);
  }

  /** Adds the lights of order[from, to) to the node's sum, and to how far their centres reach. */
  #add(from: number, to: number): void {
    const order = this.#order,
      centers = this.#centers,
      reach = this.#reach,
      store = this.#store;
    for (let i = from; i < to; i++) {
      const light = order[i] as number;
      store.unite(this.#node, light);
      for (let k = 0; k < 3; k++) {
        const c = centers[3 * light + k] as number;
        if (c < (reach[k] as number)) reach[k] = c;
        else if (c > (reach[3 + k] as number)) reach[3 + k] = c;
      }
    }
  }

  /** Chooses the axis along which the centres reach farthest; whether there is anything to split along it. */
  #choose(from: number, to: number): boolean {
    const reach = this.#reach;
    this.#axis = 0;
    for (let k = 1; k < 3; k++)
      if (
        (reach[3 + k] as number) - (reach[k] as number) >
        (reach[3 + this.#axis] as number) - (reach[this.#axis] as number)
      )
        this.#axis = k;
    this.#start = reach[this.#axis] as number;
    this.#extent = (reach[3 + this.#axis] as number) - this.#start;
    return this.#extent > 0 && to <= this.#firstDistant && to - from > 1;
  }

  /** Sorts the lights of order[from, to) into bins, and sums them up there if that tells anything. */
  #fill(from: number, to: number, sum: boolean): void {
    const order = this.#order,
      centers = this.#centers,
      bins = this.#bins,
      filled = this.#filled,
      store = this.#store;
    const axis = this.#axis,
      start = this.#start,
      extent = this.#extent;
    for (let i = from; i < to; i++) {
      const light = order[i] as number;
      const bin = Math.min(BINS - 1, Math.floor((BINS * ((centers[3 * light + axis] as number) - start)) / extent));
      bins[i] = bin;
      if (!sum) continue;
      if (filled[bin]) store.unite(this.#firstBin + bin, light);
      else store.copy(this.#firstBin + bin, light);
      filled[bin] = 1;
    }
  }

  /** Makes a node of the sum at #node. */
  #write(node: number): void {
    const v = this.#store.values,
      n = STRIDE * this.#node,
      { values } = this.tree,
      at = LIGHT_TREE_NODE.stride * node;
    for (let k = 0; k < 3; k++) {
      values[at + LIGHT_TREE_NODE.center + k] = ((v[n + k] as number) + (v[n + 3 + k] as number)) / 2;
      values[at + LIGHT_TREE_NODE.axis + k] = v[n + AXIS + k] as number;
    }
    values[at + LIGHT_TREE_NODE.radius] =
      0.5 *
      Math.hypot(
        (v[n + 3] as number) - (v[n] as number),
        (v[n + 4] as number) - (v[n + 1] as number),
        (v[n + 5] as number) - (v[n + 2] as number),
      );
    values[at + LIGHT_TREE_NODE.cosSpread] = Math.cos(v[n + SPREAD] as number);
    values[at + LIGHT_TREE_NODE.cosReach] = Math.cos(v[n + REACH] as number);
    values[at + LIGHT_TREE_NODE.energy] = v[n + ENERGY] as number;
  }

  /** Sorts order[from, to), whose bins are known, so that a split lies at the index returned. */
  #split(from: number, to: number, level: number): number {
    if (from < this.#firstDistant && to > this.#firstDistant) return this.#firstDistant;
    const middle = (from + to) >> 1;
    if (from >= this.#firstDistant) return middle;
    // Halves keep the way to a light within a trail's bits.
    const halves = this.#extent <= 0 || Math.ceil(Math.log2(to - from)) + 1 >= MOST_LEVELS - level;
    if (!halves) {
      // Two lie in the first bin and the last, and every cut is the same.
      const end = this.#partition(from, to, to - from > 2 ? this.#bestCut() : BINS - 1);
      if (end > from && end < to) return end;
    }
    const centers = this.#centers,
      axis = this.#axis;
    this.#order
      .subarray(from, to)
      .sort((a, b) => (centers[3 * a + axis] as number) - (centers[3 * b + axis] as number) || a - b);
    return middle;
  }

  /** The bin before which the lights are best cut. */
  #bestCut(): number {
    this.#sweep(this.#left, 0, 1);
    this.#sweep(this.#right, BINS - 1, -1);
    let best = 1;
    let min = Infinity;
    for (let at = 1; at < BINS; at++) {
      const sum = (this.#left[at - 1] as number) + (this.#right[at] as number);
      if (sum < min) {
        best = at;
        min = sum;
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
    const order = this.#order,
      bins = this.#bins;
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
export function* lightTreeSteps(
  lights: TreeLights,
  near: ArrayLike<number>,
  distant: ArrayLike<number> = [],
): Steps<LightTree> {
  const builder = new LightTreeBuilder(lights, near, distant);
  const count = lights.energies.length;
  for (let from = 0; from < count; from += STEP_LIGHTS, yield)
    builder.take(lights, from, Math.min(count, from + STEP_LIGHTS));
  return yield* builder.steps();
}

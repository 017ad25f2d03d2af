import { LEAF, leafFirst, leafReference, LEFT, LEFT_MIN, NODE_WORDS, RIGHT, RIGHT_MIN } from '../layout';
import { Agglomerator, GROUP_MAX } from './agglomerate';
import type { Clusters } from './clusters';
import type { NodeWriter } from './node-writer';
import { PAIR } from './primitives';

/** Numbers of a pending entry: reference or node of a group, parent, right side, depth. */
const TASK = 4;

/** What {@link Insides} needs to know. */
export interface InsidesInput {
  /** Tree over the clusters, whose leaves name places in `places`. */
  readonly upper: NodeWriter;
  /** Place in the upper tree's leaf order → cluster. */
  readonly places: Uint32Array;
  readonly clusters: Clusters;
  /** Sorted primitive → primitive. */
  readonly order: Uint32Array;
  /** Primitive → first triangle, with {@link PAIR}. */
  readonly triangles: Uint32Array;
  /** Filled with the triangles in leaf order. */
  readonly triangleIndices: Uint32Array;
  readonly maxLeaf: number;
  readonly maxDepth: number;
}

/**
 * Writes the whole tree depth first: the nodes over the clusters as they are, and under each cluster a small tree of its
 * primitives, with leaves where they cost less than going on.
 */
export class Insides {
  readonly #input: InsidesInput;
  readonly #writer: NodeWriter;
  readonly #group = new Agglomerator();
  /** Triangles under an item or node, and what it costs: area × tests, and area × nodes. */
  readonly #weights = new Uint32Array(2 * GROUP_MAX);
  readonly #costs = new Float64Array(2 * GROUP_MAX);
  readonly #leaf = new Uint8Array(2 * GROUP_MAX);
  readonly #tasks: Int32Array;
  readonly #pending = new Int32Array(3 * (GROUP_MAX + 1));
  #top = 0;
  #emitted = 0;

  constructor(writer: NodeWriter, input: InsidesInput) {
    this.#writer = writer;
    this.#input = input;
    this.#tasks = new Int32Array((input.maxDepth + 3) * TASK);
    this.#push(input.clusters.count > 1 ? 0 : leafReference(0, 1), -1, 0, 0);
  }

  #push(reference: number, parent: number, side: number, depth: number): void {
    const t = this.#top++ * TASK;
    this.#tasks[t] = reference;
    this.#tasks[t + 1] = parent;
    this.#tasks[t + 2] = side;
    this.#tasks[t + 3] = depth;
  }

  /**
   * Does some of the work.
   *
   * @param entries How many nodes and clusters of the upper tree to write.
   * @returns Whether there is more to do.
   */
  step(entries: number): boolean {
    const { upper, places } = this.#input;
    const writer = this.#writer, tasks = this.#tasks;
    const { nodes: from, words } = upper;
    for (let left = entries; this.#top > 0 && left > 0; left--) {
      const t = --this.#top * TASK;
      const reference = tasks[t] as number, parent = tasks[t + 1] as number, side = tasks[t + 2] as number, depth = tasks[t + 3] as number;
      if ((reference & LEAF) !== 0) {
        this.#cluster(places[leafFirst(reference)] as number, parent, side, depth);
        continue;
      }
      const node = writer.add(parent);
      const { nodes: to } = writer;
      if (parent >= 0) writer.words[parent * NODE_WORDS + (side === 1 ? RIGHT : LEFT)] = node;
      const a = reference * NODE_WORDS, b = node * NODE_WORDS;
      for (let k = 0; k < 3; k++) {
        to[b + LEFT_MIN + k] = from[a + LEFT_MIN + k] as number;
        to[b + LEFT_MIN + 4 + k] = from[a + LEFT_MIN + 4 + k] as number;
        to[b + RIGHT_MIN + k] = from[a + RIGHT_MIN + k] as number;
        to[b + RIGHT_MIN + 4 + k] = from[a + RIGHT_MIN + 4 + k] as number;
      }
      this.#push(words[a + RIGHT] as number, node, 1, depth + 1);
      this.#push(words[a + LEFT] as number, node, 0, depth + 1);
    }
    return this.#top > 0;
  }

  /** Writes the triangles of one sorted primitive. */
  #emit(sorted: number): void {
    const { order, triangles, triangleIndices } = this.#input;
    const primitive = triangles[order[sorted] as number] as number;
    const first = primitive & (PAIR - 1);
    triangleIndices[this.#emitted++] = first;
    if (primitive >= PAIR) triangleIndices[this.#emitted++] = first + 1;
  }

  /** The tree inside a cluster, of `depth` nodes above; its box stands in the parent already. */
  #cluster(cluster: number, parent: number, side: number, depth: number): void {
    const { clusters, order, triangles, maxLeaf, maxDepth } = this.#input;
    const { starts, sorted } = clusters;
    const writer = this.#writer, group = this.#group, weights = this.#weights, costs = this.#costs, leaf = this.#leaf, pending = this.#pending;
    const first = starts[cluster] as number, size = (starts[cluster + 1] as number) - first;
    const { boxes, children } = group;
    for (let k = 0, from = 6 * first; k < 6 * size; k++) boxes[k] = sorted[from + k] as number;
    for (let i = 0; i < size; i++) weights[i] = (triangles[order[first + i] as number] as number) >= PAIR ? 2 : 1;
    group.run(size, maxDepth - depth);
    // From the leaves up: a leaf costs its area times its triangles, a node its area and its children.
    for (let id = 0, b = 0; id < 2 * size - 1; id++, b += 6) {
      const x = (boxes[b + 3] as number) - (boxes[b] as number), y = (boxes[b + 4] as number) - (boxes[b + 1] as number), z = (boxes[b + 5] as number) - (boxes[b + 2] as number);
      const area = x * y + y * z + z * x;
      leaf[id] = 1;
      if (id < size) costs[id] = area * (weights[id] as number);
      else {
        const l = children[2 * id] as number, r = children[2 * id + 1] as number;
        const weight = (weights[l] as number) + (weights[r] as number);
        const cost = area + (costs[l] as number) + (costs[r] as number);
        weights[id] = weight;
        costs[id] = area * weight;
        if (weight <= maxLeaf && area * weight <= cost) continue;
        costs[id] = cost;
        leaf[id] = 0;
      }
    }
    let top = 1;
    pending[0] = 2 * size - 2;
    pending[1] = parent;
    pending[2] = side;
    while (top > 0) {
      const p = 3 * --top;
      const id = pending[p] as number, above = pending[p + 1] as number, right = pending[p + 2] as number;
      let reference: number;
      if (leaf[id] === 1) {
        const start = this.#emitted;
        this.#emitUnder(id, size, first);
        reference = leafReference(start, this.#emitted - start);
      } else {
        reference = writer.add(above);
        for (let k = 1; k >= 0; k--) {
          const q = 3 * top++;
          pending[q] = children[2 * id + k] as number;
          pending[q + 1] = reference;
          pending[q + 2] = k;
        }
      }
      const b = 6 * id;
      if (above < 0) {
        if (leaf[id] === 1) writer.single(reference, boxes.subarray(b, b + 6));
        continue;
      }
      writer.child(above, right === 1, reference, boxes[b] as number, boxes[b + 1] as number, boxes[b + 2] as number, boxes[b + 3] as number, boxes[b + 4] as number, boxes[b + 5] as number);
    }
  }

  readonly #below = new Uint8Array(2 * GROUP_MAX);

  /** Writes the triangles under a node of the group. */
  #emitUnder(id: number, size: number, first: number): void {
    const below = this.#below, { children } = this.#group;
    let top = 1;
    below[0] = id;
    while (top > 0) {
      const node = below[--top] as number;
      if (node < size) this.#emit(first + node);
      else {
        below[top++] = children[2 * node + 1] as number;
        below[top++] = children[2 * node] as number;
      }
    }
  }
}

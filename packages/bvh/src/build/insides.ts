import { LEAF, leafFirst, leafReference, LEFT, NODE_WORDS, PARENT, RIGHT } from '../layout';
import { Agglomerator, GROUP_MAX } from './agglomerate';
import type { Clusters } from './clusters';
import type { NodeWriter } from './node-writer';
import { PAIR } from './primitives';

/** What {@link Insides} needs to know. */
export interface InsidesInput {
  /** Tree over the clusters, whose leaves name places in `places`. */
  readonly upper: NodeWriter;
  /** Place in the upper tree's leaf order → cluster. */
  readonly places: Uint32Array;
  readonly clusters: Clusters;
  /** Sorted primitive → first triangle, with {@link PAIR}. */
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
  /** Pending references of the upper tree, four numbers each: reference, parent, right side, depth. */
  readonly #tasks: number[];
  #emitted = 0;

  constructor(writer: NodeWriter, input: InsidesInput) {
    this.#writer = writer;
    this.#input = input;
    this.#tasks = [input.clusters.count > 1 ? 0 : leafReference(0, 1), -1, 0, 0];
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
    for (let left = entries; tasks.length > 0 && left > 0; left--) {
      const depth = tasks.pop() as number, side = tasks.pop() as number, parent = tasks.pop() as number, reference = tasks.pop() as number;
      if ((reference & LEAF) !== 0) {
        this.#cluster(places[leafFirst(reference)] as number, parent, side, depth);
        continue;
      }
      const node = writer.add(parent);
      const { nodes: to } = writer;
      if (parent >= 0) writer.words[parent * NODE_WORDS + (side === 1 ? RIGHT : LEFT)] = node;
      const a = reference * NODE_WORDS, b = node * NODE_WORDS;
      // Boxes; the words between them are set with the children, but for the parent's.
      for (let k = 0; k < NODE_WORDS; k++) if (k !== PARENT) to[b + k] = from[a + k] as number;
      tasks.push(words[a + RIGHT] as number, node, 1, depth + 1, words[a + LEFT] as number, node, 0, depth + 1);
    }
    return tasks.length > 0;
  }

  /** Writes the triangles of one sorted primitive. */
  #emit(sorted: number): void {
    const { triangles, triangleIndices } = this.#input;
    const primitive = triangles[sorted] as number;
    const first = primitive & (PAIR - 1);
    triangleIndices[this.#emitted++] = first;
    if (primitive >= PAIR) triangleIndices[this.#emitted++] = first + 1;
  }

  /** The tree inside a cluster, of `depth` nodes above; its box stands in the parent already. */
  #cluster(cluster: number, parent: number, side: number, depth: number): void {
    const { clusters, triangles, maxLeaf, maxDepth } = this.#input;
    const { starts, sorted } = clusters;
    const writer = this.#writer, group = this.#group, weights = this.#weights, costs = this.#costs, leaf = this.#leaf;
    const first = starts[cluster] as number, size = (starts[cluster + 1] as number) - first;
    const { boxes, children } = group;
    for (let k = 0, from = 6 * first; k < 6 * size; k++) boxes[k] = sorted[from + k] as number;
    for (let i = 0; i < size; i++) weights[i] = 1 + ((triangles[first + i] as number) >>> 31);
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
    const write = (id: number) => {
      if (leaf[id] === 0) return 0;
      const start = this.#emitted;
      this.#emitUnder(id, size, first);
      return leafReference(start, this.#emitted - start);
    };
    const root = 2 * size - 2;
    if (parent < 0 && leaf[root] === 1) writer.single(write(root), boxes.subarray(6 * root, 6 * root + 6));
    else group.write(writer, size, parent, side, write);
  }

  readonly #below: number[] = [];

  /** Writes the triangles under a node of the group. */
  #emitUnder(id: number, size: number, first: number): void {
    const { children } = this.#group;
    const below = this.#below;
    below.push(id);
    while (below.length > 0) {
      const node = below.pop() as number;
      if (node < size) this.#emit(first + node);
      else below.push(children[2 * node + 1] as number, children[2 * node] as number);
    }
  }
}

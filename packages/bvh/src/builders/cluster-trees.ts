import { copyBox, leafReference } from '../layout';
import { Agglomerator, GROUP_MAX } from './agglomerate';
import type { Clusters } from './clusters';
import type { NodeWriter } from './node-writer';
import { NONE } from './gather';

/** Maximum number of levels of nodes in a cluster. */
export const CLUSTER_DEPTH = 8;

/**
 * Builds a small tree in each cluster, with leaves where they cost less than splitting, and appends its nodes and the
 * triangles of its leaves.
 */
export class ClusterTrees {
  readonly #clusters: Clusters;
  readonly #writer: NodeWriter;
  readonly #triangleIndices: Uint32Array;
  readonly #group: Agglomerator;
  readonly #below = new Uint8Array(2 * GROUP_MAX);
  /** First primitive of the current cluster. */
  #first = 0;
  #size = 0;
  /** Triangles written so far. */
  end = 0;

  /**
   * @param maxLeaf 0: one primitive a leaf.
   */
  constructor(clusters: Clusters, writer: NodeWriter, triangleIndices: Uint32Array, maxLeaf: number) {
    this.#clusters = clusters;
    this.#writer = writer;
    this.#triangleIndices = triangleIndices;
    this.#group = new Agglomerator(maxLeaf);
  }

  /** Builds the clusters from `from` up to `to`, and sets their boxes, weights and references. */
  build(from: number, to: number): void {
    const { boxes, weights, references, starts, primitives } = this.#clusters;
    const { names } = primitives,
      sorted = primitives.boxes;
    const group = this.#group,
      writer = this.#writer,
      none = NONE;
    const leaf = (id: number) => this.#leaf(id);
    for (let cluster = from; cluster < to; cluster++) {
      const first = (this.#first = starts[cluster] as number),
        size = (this.#size = (starts[cluster + 1] as number) - first);
      for (let i = 0; i < size; i++) {
        group.load(i, sorted, 6 * (first + i));
        group.weights[i] = names[2 * (first + i) + 1] === none ? 1 : 2;
      }
      if (group.run(size) > CLUSTER_DEPTH) group.run(size, true);
      const root = 2 * size - 2;
      if (group.leaf[root] === 1) references[cluster] = this.#leaf(root);
      else {
        references[cluster] = writer.count;
        writer.count = group.write(writer, size, 0, leaf);
      }
      weights[cluster] = group.weights[root] as number;
      copyBox(boxes, 6 * cluster, 3, group.boxes, 6 * root);
    }
  }

  /** Writes the triangles of all primitives under an item or node of the group, and gives the reference to them. */
  #leaf(id: number): number {
    const { names } = this.#clusters.primitives;
    const { children } = this.#group;
    const triangles = this.#triangleIndices,
      below = this.#below,
      size = this.#size;
    const start = this.end,
      none = NONE;
    let last = start;
    below[0] = id;
    for (let top = 1; top > 0;) {
      const at = below[--top] as number;
      if (at >= size) {
        below[top++] = children[2 * at + 1] as number;
        below[top++] = children[2 * at] as number;
        continue;
      }
      const name = 2 * (this.#first + at);
      triangles[last++] = names[name] as number;
      const second = names[name + 1] as number;
      if (second !== none) triangles[last++] = second;
    }
    this.end = last;
    return leafReference(start, last - start);
  }
}

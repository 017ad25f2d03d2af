import type { Blas } from '../blas';
import { FAR, LEAF, LEFT, leafCount, leafFirst, NODE_WORDS, parentsFirst, RIGHT, type Aabb } from '../layout';
import type { Tlas } from '../tlas';
import { WIDE_BLAS_DEPTH, WIDE_LEAF_MAX, WIDE_NODE, WIDE_TLAS_DEPTH, WIDE_WORDS, WIDTH } from './layout';

/** Nodes of eight children with quantised boxes, 80 bytes each. */
export interface WideNodes {
  /** Nodes as `bvhNodeStruct` of `@glanz/bvh/wgsl-wide` lays them out, 20 words each. Node 0 is the root. */
  readonly nodes: Uint32Array<ArrayBuffer>;
  readonly nodeCount: number;
  readonly bounds: Aabb;
}

/** A {@link Blas} in the wide layout. `packTriangles` takes it. */
export interface WideBlas extends WideNodes {
  /** Leaf order → triangle of the mesh. Not the order of the tree that it was converted from. */
  readonly triangleIndices: Uint32Array<ArrayBuffer>;
}

/** A {@link Tlas} in the wide layout. */
export interface WideTlas extends WideNodes {
  /** Leaf order → instance given. */
  readonly instanceOrder: Uint32Array<ArrayBuffer>;
  /** As in the TLAS that it was converted from. */
  readonly toObject: Float64Array<ArrayBuffer>;
}

/**
 * The wide layout of a BLAS: about 0.4 times the memory of its nodes, for devices whose caches are small. Build it
 * again after a refit. Coordinates must stay below 1e18.
 */
export function widenBlas(blas: Blas): WideBlas {
  const { nodes, nodeCount, order } = widen(blas, blas.triangleIndices.length, WIDE_BLAS_DEPTH);
  return {
    nodes,
    nodeCount,
    triangleIndices: order.map((place) => blas.triangleIndices[place] as number),
    bounds: blas.bounds,
  };
}

/** The wide layout of a TLAS. */
export function widenTlas(tlas: Tlas): WideTlas {
  const { nodes, nodeCount, order } = widen(tlas, tlas.instanceOrder.length, WIDE_TLAS_DEPTH);
  return {
    nodes,
    nodeCount,
    instanceOrder: order.map((place) => tlas.instanceOrder[place] as number),
    toObject: tlas.toObject,
    bounds: tlas.bounds,
  };
}

/** Inner nodes on the longest path down from each node; a leaf too large for one child counts as one. */
function heightsOf(words: Uint32Array, nodeCount: number): Uint8Array {
  const heights = new Uint8Array(nodeCount);
  const height = (reference: number) =>
    (reference & LEAF) === 0 ? (heights[reference] as number) : leafCount(reference) > WIDE_LEAF_MAX ? 1 : 0;
  for (const node of parentsFirst(words, nodeCount).reverse())
    heights[node] =
      1 +
      Math.max(height(words[node * NODE_WORDS + LEFT] as number), height(words[node * NODE_WORDS + RIGHT] as number));
  return heights;
}

/** @returns `order`: new leaf order → old leaf order. */
function widen(
  { nodes: from, nodeCount: fromCount }: { readonly nodes: Float32Array; readonly nodeCount: number },
  primitives: number,
  maxDepth: number,
): { nodes: Uint32Array<ArrayBuffer>; nodeCount: number; order: Uint32Array<ArrayBuffer> } {
  const words = new Uint32Array(from.buffer, from.byteOffset, from.length);
  const heights = heightsOf(words, fromCount);
  const maker = new NodeMaker();
  const order = new Uint32Array(primitives);
  let emitted = 0;
  // What each wide node stands for: a reference, and the word where its box starts in the old nodes.
  const capacity = Math.max(1, fromCount + Math.ceil(primitives / (WIDE_LEAF_MAX + 1)));
  const references = new Uint32Array(capacity),
    places = new Uint32Array(capacity),
    depths = new Uint8Array(capacity);
  let nodes = new Uint32Array(WIDE_WORDS * Math.max(1, Math.ceil(fromCount / 3)));
  let nodeCount = 1;
  for (let node = 0; node < nodeCount; node++) {
    const reference = references[node] as number;
    maker.clear();
    if ((reference & LEAF) !== 0) {
      // A leaf that is too large: its parts share its box.
      const first = leafFirst(reference),
        end = first + leafCount(reference);
      for (let part = first; part < end; part += WIDE_LEAF_MAX)
        maker.add(
          (LEAF | ((Math.min(WIDE_LEAF_MAX, end - part) - 1) << 27) | part) >>> 0,
          places[node] as number,
          from,
        );
    } else {
      maker.open(reference, words, from);
      // Levels that may be left below the children.
      const rest = 3 * (maxDepth - (depths[node] as number) - 1);
      while (maker.count < WIDTH) {
        const next = maker.largest(heights, rest);
        if (next < 0) break;
        maker.replace(next, words, from);
      }
    }
    maker.arrange();
    if ((node + 1) * WIDE_WORDS > nodes.length) {
      const more = new Uint32Array(2 * nodes.length);
      more.set(nodes);
      nodes = more;
    }
    maker.write(nodes, node, nodeCount, emitted);
    for (let slot = 0; slot < WIDTH; slot++) {
      const child = maker.slots[slot] as number;
      if (child < 0) continue;
      const own = maker.references[child] as number;
      if ((own & LEAF) !== 0 && leafCount(own) <= WIDE_LEAF_MAX) {
        for (let i = 0; i < leafCount(own); i++) order[emitted++] = leafFirst(own) + i;
      } else {
        references[nodeCount] = own;
        places[nodeCount] = maker.places[child] as number;
        depths[nodeCount++] = (depths[node] as number) + 1;
      }
    }
  }
  return { nodes: nodes.slice(0, nodeCount * WIDE_WORDS), nodeCount, order };
}

/** Gathers the children of one wide node and writes it. */
class NodeMaker {
  count = 0;
  readonly references = new Uint32Array(WIDTH);
  /** The word of each child's box: lower corner there, upper corner four words on. */
  readonly places = new Uint32Array(WIDTH);
  /** Which child is at each place of the node; −1: none. */
  readonly slots = new Int8Array(WIDTH);
  readonly #boxes = new Float32Array(6 * WIDTH);
  readonly #areas = new Float64Array(WIDTH);
  readonly #box = new Float32Array(6);
  readonly #boxBits = new Uint32Array(this.#box.buffer);

  clear(): void {
    this.count = 0;
  }

  add(reference: number, place: number, from: Float32Array): void {
    if (from[place] === FAR) return;
    this.#set(this.count++, reference, place, from);
  }

  #set(i: number, reference: number, place: number, from: Float32Array): void {
    this.references[i] = reference;
    this.places[i] = place;
    for (let k = 0; k < 3; k++) {
      this.#boxes[6 * i + k] = from[place + k] as number;
      this.#boxes[6 * i + 3 + k] = from[place + 4 + k] as number;
    }
    const [x, y, z] = [0, 1, 2].map((k) => (from[place + 4 + k] as number) - (from[place + k] as number)) as [
      number,
      number,
      number,
    ];
    this.#areas[i] = x * y + y * z + z * x;
  }

  /** Adds both children of a node. */
  open(node: number, words: Uint32Array, from: Float32Array): void {
    const base = node * NODE_WORDS;
    this.add(words[base + LEFT] as number, base, from);
    this.add(words[base + RIGHT] as number, base + 8, from);
  }

  /** Puts both children of a child in its place. */
  replace(i: number, words: Uint32Array, from: Float32Array): void {
    const base = (this.references[i] as number) * NODE_WORDS;
    this.#set(i, words[base + LEFT] as number, base, from);
    this.add(words[base + RIGHT] as number, base + 8, from);
  }

  /** The child to open: one with more than `rest` levels, else the largest; −1 if there are only leaves. */
  largest(heights: Uint8Array, rest: number): number {
    let found = -1,
      maxUrgency = -1;
    for (let i = 0; i < this.count; i++) {
      const reference = this.references[i] as number;
      if ((reference & LEAF) !== 0) continue;
      const height = heights[reference] as number;
      const urgency = height > rest ? Infinity : (this.#areas[i] as number);
      if (urgency > maxUrgency) {
        maxUrgency = urgency;
        found = i;
      }
    }
    return found;
  }

  /**
   * Gives each child a place such that a ray that goes along a diagonal of the box meets them in the order of their
   * places (Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs").
   */
  arrange(): void {
    const { count, slots } = this;
    const boxes = this.#boxes,
      box = this.#box;
    box.fill(Infinity, 0, 3);
    box.fill(-Infinity, 3);
    for (let i = 0; i < count; i++) {
      for (let k = 0; k < 3; k++) {
        box[k] = Math.min(box[k] as number, boxes[6 * i + k] as number);
        box[3 + k] = Math.max(box[3 + k] as number, boxes[6 * i + 3 + k] as number);
      }
    }
    slots.fill(-1);
    let placed = 0;
    for (let round = 0; round < count; round++) {
      let best = -Infinity,
        bestChild = 0,
        bestSlot = 0;
      for (let i = 0; i < count; i++) {
        if ((placed >> i) & 1) continue;
        const x = (boxes[6 * i] as number) + (boxes[6 * i + 3] as number) - (box[0] as number) - (box[3] as number);
        const y = (boxes[6 * i + 1] as number) + (boxes[6 * i + 4] as number) - (box[1] as number) - (box[4] as number);
        const z = (boxes[6 * i + 2] as number) + (boxes[6 * i + 5] as number) - (box[2] as number) - (box[5] as number);
        for (let slot = 0; slot < WIDTH; slot++) {
          if ((slots[slot] as number) >= 0) continue;
          const fit = (slot & 4 ? x : -x) + (slot & 2 ? y : -y) + (slot & 1 ? z : -z);
          if (fit > best) {
            best = fit;
            bestChild = i;
            bestSlot = slot;
          }
        }
      }
      slots[bestSlot] = bestChild;
      placed |= 1 << bestChild;
    }
  }

  /** Writes the node. */
  write(nodes: Uint32Array, node: number, firstNode: number, firstPrimitive: number): void {
    const at = node * WIDE_WORDS;
    const boxes = this.#boxes,
      box = this.#box;
    nodes.fill(0, at, at + WIDE_WORDS);
    nodes[at + 4] = firstNode;
    nodes[at + 5] = firstPrimitive;
    if (this.count === 0) return;
    const put = (byte: number, value: number) =>
      (nodes[at + (byte >> 2)] = (nodes[at + (byte >> 2)] as number) | (value << (8 * (byte & 3))));
    let primitives = 0;
    for (let slot = 0; slot < WIDTH; slot++) {
      const child = this.slots[slot] as number;
      if (child < 0) continue;
      const reference = this.references[child] as number;
      const count = leafCount(reference);
      if ((reference & LEAF) !== 0 && count <= WIDE_LEAF_MAX) {
        put(24 + slot, (count << 5) | primitives);
        primitives += count;
      } else {
        put(24 + slot, WIDE_NODE);
        put(15, 1 << slot);
      }
    }
    for (let k = 0; k < 3; k++) {
      const low = box[k] as number;
      nodes[at + k] = this.#boxBits[k] as number;
      // The smallest power of two of which 255 reach the upper side.
      const extent = (box[3 + k] as number) - low;
      let exponent = Math.max(-126, Math.ceil(Math.log2(extent / 255)));
      if (low + 255 * 2 ** exponent < (box[3 + k] as number)) exponent++;
      const step = 2 ** exponent;
      put(12 + k, exponent + 127);
      for (let slot = 0; slot < WIDTH; slot++) {
        const child = this.slots[slot] as number;
        if (child < 0) continue;
        const from = boxes[6 * child + k] as number,
          to = boxes[6 * child + 3 + k] as number;
        let a = Math.floor((from - low) / step),
          b = Math.ceil((to - low) / step);
        // Compensates for rounding.
        if (low + a * step > from) a--;
        if (low + b * step < to) b++;
        put(32 + 8 * k + slot, Math.max(0, a));
        put(56 + 8 * k + slot, Math.min(255, b));
      }
    }
  }
}

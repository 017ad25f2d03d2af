import { NodeWriter } from './builders/node-writer';
import { buildOverBoxes } from './builders/over-boxes';
import { BvhError } from './error';
import { instanceBoxes, type BuildBoxes, type InstanceBoxes, type TlasInstances } from './instance-boxes';
import { ABOVE_ROOT, bestSlot, boxAt, heightOf, NOWHERE, rootSurface, surfaceAt } from './insertion';
import {
  FAR,
  LEAF,
  LEFT,
  leafFirst,
  leafReference,
  LEFT_MAX,
  NODE_WORDS,
  PARENT,
  RESERVED,
  RIGHT,
  rootBounds,
  TLAS_MAX_DEPTH,
  type Aabb,
} from './layout';
import { REBUILD_ABOVE } from './refit-quality';
import type { Tlas } from './tlas';
import { checkTransform, placeInstance, type TlasInstance } from './place-instance';

export type { BoxTree, BuildBoxes, TlasInstances } from './instance-boxes';

/** Updates of more than this fraction of the instances rebuild the hierarchy at once. */
const REBUILD_PART = 1 / 4;
/** Fewer changes than this never lead to a rebuild. */
const REBUILD_MIN = 64;

/**
 * A TLAS that changes in place: moving, adding or removing one of `n` instances costs about log n, where `buildTlas`
 * costs n. Every query accepts it like the TLAS of `buildTlas`, and finds the same hits. Deterministic: the same
 * changes give the same nodes.
 *
 * A removed leaf is replaced by its sibling; an added one goes where it enlarges the boxes least, found by branch
 * and bound (Bittner, Hapala and Havran 2013, "Fast Insertion-Based Optimization of Bounding Volume Hierarchies"). An
 * instance that moves within its parent's box is refitted, any other is removed and added. The whole is rebuilt when
 * the surface area cost has risen by half, after as many changes as there are instances, and for an update of more than
 * a quarter of them.
 *
 * @example
 * const tlas = new DynamicTlas(placed.map(({ blas, transform }) => ({ bounds: blas.bounds, transform })));
 * tlas.update([[7, { bounds: blas.bounds, transform: moved }], [8, undefined]]); // 7 moves, 8 disappears
 * for (const node of tlas.takeChangedNodes()) upload(node, tlas.nodes.subarray(16 * node, 16 * node + 16));
 */
export class DynamicTlas implements Tlas {
  /** Instance `i` is leaf `i`, whether it can be hit or not. */
  readonly instanceOrder: Uint32Array<ArrayBuffer>;
  /** 12 numbers an instance, as in {@link Tlas.toObject}; only those of instances that can be hit mean anything. */
  readonly toObject: Float64Array<ArrayBuffer>;
  readonly bounds: Aabb = { min: new Float32Array(3), max: new Float32Array(3) };
  /** Memory for the maximum number of nodes. */
  #memory: Float32Array<ArrayBuffer>;
  #words: Uint32Array<ArrayBuffer>;
  #nodes: Float32Array<ArrayBuffer>;
  #nodeCount = 0;
  #count = 0;
  /** By instance: the word of the reference to it; −1 where it is not in the tree. */
  readonly #slots: Int32Array;
  /** By node: inner nodes on the longest path down, itself included. */
  readonly #heights: Uint8Array;
  /** Sum of half the surfaces of all boxes but the root's, and what the cost was after the last build. */
  #surfaces = 0;
  #builtCost = 0;
  #changes = 0;
  readonly #changed: number[] = [];
  /** Whether all nodes have changed. */
  #isBuilt = false;
  readonly #isChanged: Uint8Array;
  /** The box of the current instance: min xyz, max xyz. */
  readonly #box = new Float32Array(6);
  /** Temporary box to be written into a slot. */
  readonly #fitted = new Float32Array(6);

  /**
   * @param instances Those that are `undefined` may be added by {@link update}.
   * @throws {BvhError} `bvh/transform` for a transform without 16 numbers, `bvh/too-many` beyond 4 million instances.
   */
  constructor(instances: TlasInstances) {
    const { length } = instances;
    if (length > 2 ** TLAS_MAX_DEPTH)
      throw new BvhError('bvh/too-many', `${length} instances: one hierarchy holds ${2 ** TLAS_MAX_DEPTH}.`);
    const capacity = Math.max(length - 1, 1);
    this.instanceOrder = new Uint32Array(length).map((_, i) => i);
    this.toObject = new Float64Array(12 * length);
    this.#memory = this.#nodes = new Float32Array(capacity * NODE_WORDS);
    this.#words = new Uint32Array(this.#memory.buffer);
    this.#slots = new Int32Array(length).fill(-1);
    this.#heights = new Uint8Array(capacity);
    this.#isChanged = new Uint8Array(capacity);
    this.#build(instanceBoxes(instances, this.toObject));
  }

  /**
   * A hierarchy whose first tree is built elsewhere, such as by `GpuBuilder` of `@glanz/bvh/gpu`: of a million instances,
   * building takes most of the time. Later changes are made here.
   *
   * @throws {BvhError} as the constructor; what `build` throws.
   */
  static async create(instances: TlasInstances, build: BuildBoxes): Promise<DynamicTlas> {
    const { length } = instances;
    const tlas = new DynamicTlas({ length, at: () => undefined });
    const placed = instanceBoxes(instances, tlas.toObject);
    const kept = placed.instances;
    const tree = await build(placed.boxes.subarray(0, 6 * kept.length), kept.length);
    if (tree) {
      tlas.#memory.set(tree.nodes.subarray(0, tree.nodeCount * NODE_WORDS));
      tlas.#adopt(
        tree.nodeCount,
        tree.order.map((box) => kept[box] as number),
      );
    } else tlas.#build(placed);
    return tlas;
  }

  /** As in {@link Tlas.nodes}, but for their order: a child may lie before its parent. Another view after an update. */
  get nodes(): Float32Array<ArrayBuffer> {
    return this.#nodes;
  }

  get nodeCount(): number {
    return this.#nodeCount;
  }

  /** How many instances are in the hierarchy. */
  get count(): number {
    return this.#count;
  }

  /** Whether an instance is in the hierarchy: it was given, and something can hit it. */
  has(instance: number): boolean {
    return (this.#slots[instance] ?? -1) >= 0;
  }

  /**
   * Moves, adds and removes instances.
   *
   * @param changes The number of an instance and where it is now; `undefined` removes it. The last change to an
   * instance counts.
   * @throws {BvhError} `bvh/instance` for a number that was not given to the constructor, `bvh/transform`. The
   * hierarchy is then unchanged.
   */
  update(changes: readonly (readonly [instance: number, placing: TlasInstance | undefined])[]): void {
    for (const [instance, placing] of changes) {
      if (this.#slots[instance] === undefined)
        throw new BvhError(
          'bvh/instance',
          `There is no instance ${instance}; the hierarchy has ${this.#slots.length}.`,
        );
      if (placing) checkTransform(placing, instance);
    }
    this.#changes += changes.length;
    const limit = Math.max(REBUILD_MIN, this.#count);
    if (changes.length > Math.max(REBUILD_MIN, this.#slots.length * REBUILD_PART)) return this.#rebuild(changes);
    for (let i = 0; i < changes.length; i++) {
      const [instance, placing] = changes[i] as (typeof changes)[number];
      if (!this.#change(instance, placing)) return this.#rebuild(changes.slice(i));
    }
    if (
      this.#changes >= limit ||
      (this.#changes >= Math.max(REBUILD_MIN, limit / 16) && this.#cost() > REBUILD_ABOVE * this.#builtCost)
    )
      this.#rebuild([]);
    else this.#finish();
  }

  /** The nodes written since the last call, in ascending order; at first, all of them. For uploads. */
  takeChangedNodes(): Uint32Array<ArrayBuffer> {
    const changed = this.#isBuilt
      ? new Uint32Array(this.#nodeCount).map((_, i) => i)
      : Uint32Array.from(this.#changed.filter((node) => node < this.#nodeCount)).sort();
    for (const node of this.#changed) this.#isChanged[node] = 0;
    this.#changed.length = 0;
    this.#isBuilt = false;
    return changed;
  }

  /** False where the tree would get too deep: it is then valid, without the instance. */
  #change(instance: number, placing: TlasInstance | undefined): boolean {
    const box = this.#box;
    const slot = this.#slots[instance] as number;
    const isPlaced = placing !== undefined && placeInstance(placing, box, 0, this.toObject, 12 * instance);
    if (!isPlaced) {
      if (slot >= 0) this.#remove(instance, slot);
      return true;
    }
    if (slot >= 0) {
      if (this.#staysInside(slot)) {
        this.#setBox(slot, box);
        this.#refit(slot >>> 4);
        return true;
      }
      this.#remove(instance, slot);
    }
    return this.#insert(instance);
  }

  /** Whether the current box lies within that of the node which holds a slot. */
  #staysInside(slot: number): boolean {
    const box = this.#box,
      memory = this.#memory;
    const node = slot >>> 4;
    if (node === 0) return true;
    const at = boxAt(this.#slotOf(node));
    for (let k = 0; k < 3; k++)
      if ((box[k] as number) < (memory[at + k] as number) || (box[3 + k] as number) > (memory[at + 4 + k] as number))
        return false;
    return true;
  }

  /** The slot that refers to a node other than the root. */
  #slotOf(node: number): number {
    const base = (this.#words[node * NODE_WORDS + PARENT] as number) * NODE_WORDS;
    return base + (this.#words[base + LEFT] === node ? LEFT : RIGHT);
  }

  #mark(node: number): void {
    if (this.#isChanged[node]) return;
    this.#isChanged[node] = 1;
    this.#changed.push(node);
  }

  #setBox(slot: number, box: Float32Array): void {
    const memory = this.#memory,
      at = boxAt(slot);
    this.#surfaces -= surfaceAt(this.#memory, slot);
    for (let k = 0; k < 3; k++) {
      memory[at + k] = box[k] as number;
      memory[at + 4 + k] = box[3 + k] as number;
    }
    this.#surfaces += surfaceAt(this.#memory, slot);
    this.#mark(slot >>> 4);
  }

  /** Copies reference and box of one slot to another, and updates the back reference. */
  #copySlot(from: number, to: number): void {
    const memory = this.#memory;
    const a = boxAt(from),
      b = boxAt(to);
    this.#surfaces -= surfaceAt(this.#memory, to);
    for (let k = 0; k < 3; k++) {
      memory[b + k] = memory[a + k] as number;
      memory[b + 4 + k] = memory[a + 4 + k] as number;
    }
    this.#surfaces += surfaceAt(this.#memory, to);
    this.#refer(to, this.#words[from] as number);
  }

  /** Writes a reference, and the back reference of its target. */
  #refer(slot: number, reference: number): void {
    this.#words[slot] = reference;
    this.#mark(slot >>> 4);
    if (reference >= LEAF) this.#slots[leafFirst(reference)] = slot;
    else {
      this.#words[reference * NODE_WORDS + PARENT] = slot >>> 4;
      this.#mark(reference);
    }
  }

  /** Makes a slot one that no ray reaches. */
  #clear(slot: number, reference: number): void {
    this.#setBox(slot, this.#fitted.fill(FAR));
    this.#words[slot] = reference;
  }

  /** A new node of zero surface, to be filled by the caller. */
  #newNode(): number {
    const node = this.#nodeCount++;
    this.#memory.fill(0, node * NODE_WORDS, (node + 1) * NODE_WORDS);
    this.#heights[node] = 0;
    this.#mark(node);
    return node;
  }

  /** Frees a node that nothing refers to: the last node takes its place. @returns Where `watched` is now. */
  #freeNode(node: number, watched: number): number {
    const last = --this.#nodeCount;
    this.#surfaces -=
      surfaceAt(this.#memory, node * NODE_WORDS + LEFT) + surfaceAt(this.#memory, node * NODE_WORDS + RIGHT);
    if (node === last) return watched;
    const slot = this.#slotOf(last);
    const to = node * NODE_WORDS,
      from = last * NODE_WORDS;
    this.#memory.copyWithin(to, from, from + NODE_WORDS);
    this.#heights[node] = this.#heights[last] as number;
    this.#refer(slot, node);
    this.#refer(to + LEFT, this.#words[to + LEFT] as number);
    this.#refer(to + RIGHT, this.#words[to + RIGHT] as number);
    return watched === last ? node : watched;
  }

  #remove(instance: number, slot: number): void {
    const sibling = slot ^ LEFT_MAX;
    const node = slot >>> 4;
    this.#slots[instance] = -1;
    this.#count--;
    if (this.#count < 2) {
      // What is left, if anything, is the root's first child.
      const rest = this.#words[sibling] as number;
      if (this.#count === 1 && slot === LEFT) this.#copySlot(RIGHT, LEFT);
      else if (this.#count === 0) this.#clear(LEFT, rest);
      this.#clear(RIGHT, rest);
      return;
    }
    if (node === 0) {
      const child = this.#words[sibling] as number;
      this.#copySlot(child * NODE_WORDS + LEFT, LEFT);
      this.#copySlot(child * NODE_WORDS + RIGHT, RIGHT);
      this.#freeNode(child, 0);
      this.#refit(0);
      return;
    }
    const above = this.#slotOf(node);
    this.#copySlot(sibling, above);
    this.#refit(this.#freeNode(node, above >>> 4));
  }

  /** Inserts the current box. False where the tree would get too deep. */
  #insert(instance: number): boolean {
    const reference = leafReference(instance, 1);
    if (this.#count < 2) {
      const slot = this.#count === 0 ? LEFT : RIGHT;
      this.#setBox(slot, this.#box);
      this.#refer(slot, reference);
      if (slot === LEFT) this.#words[RIGHT] = reference;
      this.#heights[0] = 1;
      this.#count++;
      return true;
    }
    const slot = bestSlot(this.#memory, this.#words, this.#heights, this.#box, TLAS_MAX_DEPTH);
    if (slot === NOWHERE) return false;
    this.#count++;
    const node = this.#newNode();
    const left = node * NODE_WORDS + LEFT,
      right = node * NODE_WORDS + RIGHT;
    if (slot === ABOVE_ROOT) {
      // The new node takes the root's children.
      this.#copySlot(LEFT, left);
      this.#copySlot(RIGHT, right);
      this.#setBox(RIGHT, this.#box);
      this.#refer(RIGHT, reference);
      this.#refer(LEFT, node);
      this.#refit(node);
      return true;
    }
    this.#copySlot(slot, left);
    this.#setBox(right, this.#box);
    this.#refer(right, reference);
    this.#refer(slot, node);
    this.#refit(node);
    return true;
  }

  /** Fits boxes and heights from a node up to the root, or to where nothing changes. */
  #refit(node: number): void {
    const words = this.#words,
      memory = this.#memory,
      box = this.#fitted,
      heights = this.#heights;
    for (;;) {
      const base = node * NODE_WORDS;
      const height =
        1 +
        Math.max(
          heightOf(this.#heights, words[base + LEFT] as number),
          heightOf(this.#heights, words[base + RIGHT] as number),
        );
      const isSameHeight = heights[node] === height;
      heights[node] = height;
      if (node === 0) return;
      const slot = this.#slotOf(node),
        at = boxAt(slot);
      let isSame = isSameHeight;
      for (let k = 0; k < 3; k++) {
        box[k] = Math.min(memory[base + k] as number, memory[base + 8 + k] as number);
        box[3 + k] = Math.max(memory[base + 4 + k] as number, memory[base + 12 + k] as number);
        isSame &&= box[k] === memory[at + k] && box[3 + k] === memory[at + 4 + k];
      }
      if (isSame) return;
      this.#setBox(slot, box);
      node = slot >>> 4;
    }
  }

  /** The surface area cost, without the terms that are the same in all trees. */
  #cost(): number {
    const root = rootSurface(this.#memory);
    return root > 0 ? this.#surfaces / root : 0;
  }

  #rebuild(changes: readonly (readonly [instance: number, placing: TlasInstance | undefined])[]): void {
    const slots = this.#slots,
      memory = this.#memory;
    const boxes = new Float32Array(6 * slots.length);
    const kept = new Uint32Array(slots.length);
    const latest = new Map(changes);
    let count = 0;
    for (let i = 0; i < slots.length; i++) {
      const slot = slots[i] as number;
      if (latest.has(i)) {
        const placing = latest.get(i);
        if (placing && placeInstance(placing, boxes, 6 * count, this.toObject, 12 * i)) kept[count++] = i;
      } else if (slot >= 0) {
        for (let k = 0; k < 3; k++) {
          boxes[6 * count + k] = memory[boxAt(slot) + k] as number;
          boxes[6 * count + 3 + k] = memory[boxAt(slot) + 4 + k] as number;
        }
        kept[count++] = i;
      }
    }
    this.#build({ boxes, instances: kept.subarray(0, count) });
  }

  #build({ boxes, instances }: InstanceBoxes): void {
    // Into the memory that is there: a copy of the nodes of a million instances would be 64 MB.
    const writer = new NodeWriter(this.#heights.length, this.#memory.buffer);
    this.#adopt(buildOverBoxes(boxes, instances.length, TLAS_MAX_DEPTH, writer).count, instances);
  }

  /**
   * Makes the tree that is in memory the hierarchy.
   *
   * @param leaves Leaf order → instance.
   */
  #adopt(nodeCount: number, leaves: Uint32Array): void {
    this.#nodeCount = nodeCount;
    this.#count = leaves.length;
    this.#slots.fill(-1);
    this.#surfaces = 0;
    const words = this.#words;
    for (let node = nodeCount - 1; node >= 0; node--) {
      const base = node * NODE_WORDS;
      for (let slot = base + LEFT; slot <= base + RIGHT; slot += RIGHT - LEFT) {
        const reference = words[slot] as number;
        if (reference >= LEAF) {
          // A tree of nothing has a leaf all the same.
          const instance = leaves[leafFirst(reference)] ?? 0;
          words[slot] = leafReference(instance, 1);
          if (this.#memory[boxAt(slot)] !== FAR) this.#slots[instance] = slot;
        }
        this.#surfaces += surfaceAt(this.#memory, slot);
      }
      words[base + RESERVED] = 0;
      // Built trees have children behind their parents.
      this.#heights[node] =
        1 +
        Math.max(
          heightOf(this.#heights, words[base + LEFT] as number),
          heightOf(this.#heights, words[base + RIGHT] as number),
        );
    }
    this.#isBuilt = true;
    this.#changes = 0;
    this.#builtCost = this.#cost();
    this.#finish();
  }

  #finish(): void {
    if (this.#nodes.length !== this.#nodeCount * NODE_WORDS)
      this.#nodes = this.#memory.subarray(0, this.#nodeCount * NODE_WORDS);
    const { min, max } = rootBounds(this.#memory);
    this.bounds.min.set(min);
    this.bounds.max.set(max);
  }
}

import { encloseChildren, LEAF, leafReference, LEFT, NODE_WORDS, RIGHT } from '../layout';
import { Agglomerator, GROUP_MAX } from './agglomerate';
import type { NodeWriter } from './node-writer';
import { Splitter } from './splitter';

/** Ranges whose longest side has become as short as this are quantised again, in finer steps. */
const COARSE = 512;

/** Items with boxes to build over. */
export interface Items {
  /** Six numbers each: min xyz, max xyz; finite. */
  readonly boxes: Float32Array;
  /** Cost of testing each; default 1. */
  readonly weights?: Uint32Array;
  /** Number of items, at least two. */
  readonly count: number;
}

/**
 * Builds a tree over items, one item a leaf, without recursion: large ranges are split by surface area heuristic, small
 * ones joined bottom up. The depth is bounded for any input: no side of a split has more items than the levels below it
 * can hold, and a small range whose joined tree would be too high is split as large ones are. Where no plane separates
 * the centres, ranges are halved by count. The boxes of inner children are not set: {@link encloseNodes}.
 */
export class Levels {
  readonly #writer: NodeWriter;
  readonly #items: Items;
  /** Four words for each item, in their order, as {@link Splitter.split} takes them. */
  readonly #words: Int32Array;
  readonly #maxDepth: number;
  readonly #splitter: Splitter;
  readonly #group = new Agglomerator(0);
  /** Pending ranges, ten numbers each: bounds of the centres, first, end, word for the reference, depth. */
  readonly tasks: number[];
  /** Bounds of the centres of the current range, doubled: min xyz, max xyz. */
  readonly #centers = new Int32Array(6);

  /**
   * @param maxDepth Maximum number of inner nodes on the path to an item; 2 ** maxDepth must not be less than the
   * number of items.
   * @param words Four numbers for each item, to work in.
   */
  constructor(
    writer: NodeWriter,
    items: Items,
    maxDepth: number,
    bins: number,
    words = new Int32Array(4 * items.count),
  ) {
    this.#writer = writer;
    this.#items = items;
    this.#words = words;
    this.#maxDepth = maxDepth;
    this.#splitter = new Splitter(bins);
    for (let i = 0; i < items.count; i++) words[4 * i + 3] = i;
    this.#quantise(0, items.count);
    this.tasks = [...this.#centers, 0, items.count, 0, 0];
  }

  /**
   * Does some of the work.
   *
   * @param items About how many items to visit.
   * @returns Whether there is more to do.
   */
  step(items: number): boolean {
    const tasks = this.tasks,
      splitter = this.#splitter,
      centers = this.#centers;
    for (let left = items; tasks.length > 0 && left > 0;) {
      const depth = tasks.pop() as number,
        slot = tasks.pop() as number,
        end = tasks.pop() as number,
        first = tasks.pop() as number;
      centers.set(tasks.splice(-6));
      const size = end - first;
      left -= size;
      if (size <= GROUP_MAX && this.#join(first, size, slot, depth)) continue;
      // No side has a bit of COARSE, a power of two, or a higher one.
      let sides = 0;
      for (let k = 0; k < 3; k++) sides |= (centers[3 + k] as number) - (centers[k] as number);
      if (sides < COARSE) this.#quantise(first, end);
      splitter.split(this.#words, this.#items.weights, first, end, centers, 2 ** (this.#maxDepth - depth - 1));
      const { cut } = splitter;
      const base = this.#writer.under(slot) * NODE_WORDS;
      tasks.push(
        ...splitter.right,
        cut,
        end,
        base + RIGHT,
        depth + 1,
        ...splitter.left,
        first,
        cut,
        base + LEFT,
        depth + 1,
      );
    }
    return tasks.length > 0;
  }

  /** Quantises a range in its own steps, and records the bounds of its centres. */
  #quantise(first: number, end: number): void {
    const STEPS = 32767;
    const { boxes } = this.#items;
    const words = this.#words,
      centers = this.#centers;
    const low: number[] = [];
    let extent = 0;
    for (let k = 0; k < 3; k++) {
      let a = Infinity,
        b = -Infinity;
      for (let i = first; i < end; i++) {
        const box = 6 * (words[4 * i + 3] as number) + k;
        a = Math.min(a, boxes[box] as number);
        b = Math.max(b, boxes[box + 3] as number);
      }
      low[k] = a;
      extent = Math.max(extent, b - a);
      centers[k] = 2 * STEPS;
      centers[3 + k] = 0;
    }
    const scale = extent > 0 ? STEPS / extent : 0;
    for (let i = first; i < end; i++) {
      const item = words[4 * i + 3] as number;
      for (let k = 0; k < 3; k++) {
        const box = 6 * item + k;
        const a = (((boxes[box] as number) - (low[k] as number)) * scale) | 0,
          b = (((boxes[box + 3] as number) - (low[k] as number)) * scale) | 0;
        words[4 * i + k] = b | ((STEPS - a) << 16);
        centers[k] = Math.min(centers[k] as number, a + b);
        centers[3 + k] = Math.max(centers[3 + k] as number, a + b);
      }
    }
  }

  /** Writes the tree of a small range, unless it is too high. @returns Whether it was written. */
  #join(first: number, size: number, slot: number, depth: number): boolean {
    const group = this.#group,
      words = this.#words,
      writer = this.#writer;
    const { boxes } = this.#items;
    const itemAt = (i: number) => words[4 * (first + i) + 3] as number;
    if (size === 1) {
      const item = itemAt(0);
      writer.put(slot, leafReference(item, 1), boxes, 6 * item);
      return true;
    }
    for (let i = 0; i < size; i++) group.load(i, boxes, 6 * itemAt(i));
    if (group.run(size) > this.#maxDepth - depth) return false;
    writer.count = group.write(writer, size, slot, (id) => leafReference(itemAt(id), 1));
    return true;
  }
}

/** Sets the boxes of inner children, which lie behind their parents. */
export function encloseNodes({ nodes, words }: NodeWriter, from: number, end: number): void {
  // Halves of nodes: a child's box, and its reference three words behind the box's start or one before it.
  for (let half = 2 * end - 1; half >= 2 * from; half--) {
    const box = 8 * half,
      reference = words[box + 3 - 4 * (half & 1)] as number;
    if (reference < LEAF) encloseChildren(nodes, box, box + 4, 16 * reference);
  }
}

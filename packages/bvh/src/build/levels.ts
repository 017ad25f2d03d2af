import { leafReference } from '../layout';
import { Agglomerator, GROUP_MAX } from './agglomerate';
import type { NodeWriter } from './node-writer';
import { Splitter } from './splitter';

/** Numbers of a pending range: first, end, parent, right side, depth. */
const TASK = 5;

/** Things with boxes to build over. */
export interface Items {
  /** Six numbers each: min xyz, max xyz; finite. */
  readonly boxes: Float32Array;
  /** What each costs to test. */
  readonly weights: Uint32Array;
  /** Which to build over; permuted. */
  readonly order: Uint32Array;
  /** How many of `order`, at least two. */
  readonly count: number;
}

/** 0, 1, 2, … */
export function counted(list: Uint32Array, count: number): Uint32Array {
  for (let i = 0; i < count; i++) list[i] = i;
  return list;
}

/**
 * Builds a tree over items, one item a leaf, without recursion: large ranges are split by surface area heuristic, small
 * ones joined bottom up. Where the depth left would not suffice, or no plane separates the centres, ranges are halved by
 * count, so the depth is bounded for any input.
 */
export class Levels {
  readonly #writer: NodeWriter;
  readonly #items: Items;
  readonly #maxDepth: number;
  readonly #splitter: Splitter;
  readonly #group = new Agglomerator();
  readonly #members = new Uint32Array(GROUP_MAX);
  /** Pending nodes of a group: id, parent, side. */
  readonly #pending = new Int32Array(3 * (GROUP_MAX + 1));
  readonly #tasks: Int32Array;
  #top = 0;

  /** @param maxDepth Most inner nodes on the way to an item; 2 ** maxDepth must not be less than the number of items. */
  constructor(writer: NodeWriter, items: Items, maxDepth: number, bins: number) {
    this.#writer = writer;
    this.#items = items;
    this.#maxDepth = maxDepth;
    this.#splitter = new Splitter(bins);
    this.#tasks = new Int32Array((maxDepth + 3) * TASK);
    this.#push(0, items.count, -1, 0, 0);
  }

  #push(first: number, end: number, parent: number, right: number, depth: number): void {
    const t = this.#top++ * TASK;
    const tasks = this.#tasks;
    tasks[t] = first;
    tasks[t + 1] = end;
    tasks[t + 2] = parent;
    tasks[t + 3] = right;
    tasks[t + 4] = depth;
  }

  /**
   * Does some of the work.
   *
   * @param items About how many items to look at.
   * @returns Whether there is more to do.
   */
  step(items: number): boolean {
    const tasks = this.#tasks, splitter = this.#splitter, writer = this.#writer;
    const { boxes, weights, order } = this.#items;
    for (let left = items; this.#top > 0 && left > 0; ) {
      const t = --this.#top * TASK;
      const first = tasks[t] as number, end = tasks[t + 1] as number, parent = tasks[t + 2] as number, right = tasks[t + 3] === 1, depth = tasks[t + 4] as number;
      const size = end - first;
      left -= size;
      if (size <= GROUP_MAX) {
        this.#join(first, size, parent, right, depth);
        continue;
      }
      // With the levels that halving would need from here on.
      const free = depth + 33 - Math.clz32(size - 1) < this.#maxDepth;
      if (free) splitter.bin(boxes, weights, order, first, end);
      else splitter.measure(boxes, order, first, end);
      const node = writer.add(parent);
      if (parent >= 0) writer.child(parent, right, node, splitter.x0, splitter.y0, splitter.z0, splitter.x1, splitter.y1, splitter.z1);
      const cut = splitter.cut < 0 ? (first + end) >>> 1 : splitter.cut;
      this.#push(cut, end, node, 1, depth + 1);
      this.#push(first, cut, node, 0, depth + 1);
    }
    return this.#top > 0;
  }

  /** The tree of a small range. */
  #join(first: number, size: number, parent: number, right: boolean, depth: number): void {
    const group = this.#group, members = this.#members, pending = this.#pending, writer = this.#writer;
    const { boxes, order } = this.#items;
    const own = group.boxes;
    for (let i = 0, to = 0; i < size; i++, to += 6) {
      const item = order[first + i] as number;
      members[i] = item;
      for (let k = 0; k < 6; k++) own[to + k] = boxes[6 * item + k] as number;
    }
    group.run(size, this.#maxDepth - depth);
    let top = 0, place = first;
    pending[0] = 2 * size - 2;
    pending[1] = parent;
    pending[2] = right ? 1 : 0;
    for (top = 1; top > 0; ) {
      const p = 3 * --top;
      const id = pending[p] as number, above = pending[p + 1] as number, side = pending[p + 2] === 1;
      let reference: number;
      if (id < size) {
        order[place] = members[id] as number;
        reference = leafReference(place++, 1);
      } else {
        reference = writer.add(above);
        for (let k = 1; k >= 0; k--) {
          const q = 3 * top++;
          pending[q] = group.children[2 * id + k] as number;
          pending[q + 1] = reference;
          pending[q + 2] = k;
        }
      }
      const b = 6 * id;
      if (above >= 0) writer.child(above, side, reference, own[b] as number, own[b + 1] as number, own[b + 2] as number, own[b + 3] as number, own[b + 4] as number, own[b + 5] as number);
    }
  }
}

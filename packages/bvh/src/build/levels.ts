import { leafReference } from '../layout';
import { Agglomerator, GROUP_MAX } from './agglomerate';
import type { NodeWriter } from './node-writer';
import { Splitter } from './splitter';

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
  /** Pending ranges, five numbers each: first, end, parent, right side, depth. */
  readonly #tasks: number[];

  /** @param maxDepth Most inner nodes on the way to an item; 2 ** maxDepth must not be less than the number of items. */
  constructor(writer: NodeWriter, items: Items, maxDepth: number, bins: number) {
    this.#writer = writer;
    this.#items = items;
    this.#maxDepth = maxDepth;
    this.#splitter = new Splitter(bins);
    this.#tasks = [0, items.count, -1, 0, 0];
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
    for (let left = items; tasks.length > 0 && left > 0; ) {
      const depth = tasks.pop() as number, right = tasks.pop() as number, parent = tasks.pop() as number, end = tasks.pop() as number, first = tasks.pop() as number;
      const size = end - first;
      left -= size;
      if (size <= GROUP_MAX) {
        this.#join(first, size, parent, right, depth);
        continue;
      }
      // With the levels that halving would need from here on.
      const free = depth + 33 - Math.clz32(size - 1) < this.#maxDepth;
      splitter.split(boxes, weights, order, first, end, free);
      const node = writer.add(parent);
      if (parent >= 0) writer.childBox(parent, right === 1, node, splitter.box, 0);
      const cut = splitter.cut < 0 ? (first + end) >>> 1 : splitter.cut;
      tasks.push(cut, end, node, 1, depth + 1, first, cut, node, 0, depth + 1);
    }
    return tasks.length > 0;
  }

  /** The tree of a small range. */
  #join(first: number, size: number, parent: number, right: number, depth: number): void {
    const group = this.#group, members = this.#members, writer = this.#writer;
    const { boxes, order } = this.#items;
    const own = group.boxes;
    for (let i = 0, to = 0; i < size; i++, to += 6) {
      const item = order[first + i] as number;
      members[i] = item;
      for (let k = 0; k < 6; k++) own[to + k] = boxes[6 * item + k] as number;
    }
    group.run(size, this.#maxDepth - depth);
    let place = first;
    group.write(writer, size, parent, right, (id) => {
      if (id >= size) return 0;
      order[place] = members[id] as number;
      return leafReference(place++, 1);
    });
  }
}

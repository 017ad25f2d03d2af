import type { NodeWriter } from './node-writer';
import { Splitter, SWEEP_MAX } from './splitter';

/** Numbers of a pending range: first, end, parent, right side, depth, inside of a cluster. */
const TASK = 6;

/** Things with boxes to build over. */
export interface Items {
  /** Six numbers each: min xyz, max xyz; finite. */
  readonly boxes: Float32Array;
  /** What each costs to test. */
  readonly weights: Uint32Array;
  /** Which to build over; permuted. */
  readonly order: Uint32Array;
}

/** What {@link buildLevels} is told. */
export interface LevelsOptions {
  /** Most weight in a leaf. */
  readonly maxLeaf: number;
  /** Most inner nodes on the way to a leaf, and to an outer item. */
  readonly maxDepth: number;
  readonly outerDepth: number;
  readonly bins: number;
  /** Gives the reference to a leaf of `inner.order[first, end)`. Asked in the order of the leaves. */
  readonly leaf: (first: number, end: number) => number;
}

/** 0, 1, 2, … */
export function counted(count: number): Uint32Array {
  const list = new Uint32Array(count);
  for (let i = 0; i < count; i++) list[i] = i;
  return list;
}

/**
 * Builds by surface area heuristic over outer items, and within each over the inner items `starts[i]` to `starts[i + 1]`,
 * without recursion. Where the depth left would not suffice, or no plane separates the centres, ranges are halved by
 * count, so the depth is bounded for any input. There must be at least two inner items.
 */
export function buildLevels(writer: NodeWriter, outer: Items, inner: Items, starts: Uint32Array, { maxLeaf, maxDepth, outerDepth, bins, leaf }: LevelsOptions): void {
  const splitter = new Splitter(bins);
  const tasks = new Int32Array((maxDepth + 3) * TASK);
  let top = 0;
  const push = (first: number, end: number, parent: number, right: number, depth: number, inside: number) => {
    const t = top++ * TASK;
    tasks[t] = first;
    tasks[t + 1] = end;
    tasks[t + 2] = parent;
    tasks[t + 3] = right;
    tasks[t + 4] = depth;
    tasks[t + 5] = inside;
  };
  push(0, outer.order.length, -1, 0, 0, 0);
  while (top > 0) {
    const t = --top * TASK;
    let first = tasks[t] as number, end = tasks[t + 1] as number, inside = tasks[t + 5] as number;
    const parent = tasks[t + 2] as number, right = tasks[t + 3] === 1, depth = tasks[t + 4] as number;
    if (inside === 0 && end - first === 1) {
      const item = outer.order[first] as number;
      first = starts[item] as number;
      end = starts[item + 1] as number;
      inside = 1;
    }
    const size = end - first;
    const { boxes, weights, order } = inside ? inner : outer;
    // With the levels that halving would need from here on.
    const free = depth + 33 - Math.clz32(size - 1) < (inside ? maxDepth : outerDepth);
    if (size === 1 || !free) splitter.measure(boxes, weights, order, first, end);
    else if (size <= SWEEP_MAX) splitter.sweep(boxes, weights, order, first, end);
    else splitter.bin(boxes, weights, order, first, end);
    const { x0, y0, z0, x1, y1, z1, weight } = splitter;
    let { cut } = splitter;
    const dx = x1 - x0, dy = y1 - y0, dz = z1 - z0;
    const area = dx * dy + dy * dz + dz * dx;
    // Splitting must pay: costs are over the probability of a hit, which is the box's area.
    if (inside && parent >= 0 && weight <= maxLeaf && !(splitter.cost + area < weight * area)) {
      writer.child(parent, right, leaf(first, end), x0, y0, z0, x1, y1, z1);
      continue;
    }
    const node = writer.add(parent);
    if (parent >= 0) writer.child(parent, right, node, x0, y0, z0, x1, y1, z1);
    if (cut < 0) cut = (first + end) >>> 1;
    push(cut, end, node, 1, depth + 1, inside);
    push(first, cut, node, 0, depth + 1, inside);
  }
}

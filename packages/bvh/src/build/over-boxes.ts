import { leafReference } from '../layout';
import { NodeWriter, type Tree } from './node-writer';
import { Splitter, SWEEP_MAX } from './splitter';

/** Numbers of a pending range: first, end, parent, right side, depth. */
const TASK = 5;

/**
 * Builds over boxes by surface area heuristic, one box a leaf. Where the depth left would not suffice, or no plane
 * separates the centres, ranges are halved by count, so the depth is bounded for any input.
 *
 * @param boxes Six numbers each: min xyz, max xyz; finite.
 * @param order Boxes to build over; permuted into leaf order.
 */
export function buildOverBoxes(boxes: Float32Array, order: Uint32Array, maxDepth: number): Tree {
  const count = order.length;
  const writer = new NodeWriter(Math.max(count - 1, 1));
  const splitter = new Splitter(16);
  const weights = new Uint32Array(boxes.length / 6).fill(1);
  if (count < 2) {
    // Both references name the one leaf; for no boxes at all, a leaf that is never reached.
    const root = writer.add(-1);
    const reference = leafReference(0, 1);
    splitter.measure(boxes, weights, order, 0, count);
    if (count === 1) writer.child(root, false, reference, splitter.x0, splitter.y0, splitter.z0, splitter.x1, splitter.y1, splitter.z1);
    else writer.noChild(root, false, reference);
    writer.noChild(root, true, reference);
    return writer.finish();
  }
  const tasks = new Int32Array((maxDepth + 3) * TASK);
  tasks.set([0, count, -1, 0, 0]);
  let top = 1;
  while (top > 0) {
    const t = --top * TASK;
    const first = tasks[t] as number, end = tasks[t + 1] as number, parent = tasks[t + 2] as number, right = tasks[t + 3] === 1, depth = tasks[t + 4] as number;
    const size = end - first;
    const free = depth + 32 - Math.clz32(size - 1) + 1 < maxDepth;
    if (size === 1 || !free) {
      splitter.measure(boxes, weights, order, first, end);
      splitter.cut = -1;
    } else if (size <= SWEEP_MAX) splitter.sweep(boxes, weights, order, first, end);
    else splitter.bin(boxes, weights, order, first, end);
    const { x0, y0, z0, x1, y1, z1 } = splitter;
    if (size === 1) {
      writer.child(parent, right, leafReference(first, 1), x0, y0, z0, x1, y1, z1);
      continue;
    }
    const node = writer.add(parent);
    if (parent >= 0) writer.child(parent, right, node, x0, y0, z0, x1, y1, z1);
    const cut = splitter.cut < 0 ? (first + end) >>> 1 : splitter.cut;
    tasks.set([cut, end, node, 1, depth + 1], top++ * TASK);
    tasks.set([first, cut, node, 0, depth + 1], top++ * TASK);
  }
  return writer.finish();
}

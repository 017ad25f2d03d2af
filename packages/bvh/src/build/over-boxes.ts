import { leafReference } from '../layout';
import { Levels } from './levels';
import { NodeWriter, type Tree } from './node-writer';

/**
 * Builds over boxes by surface area heuristic, one box a leaf.
 *
 * @param boxes Six numbers each: min xyz, max xyz; finite.
 * @param order Boxes to build over; permuted into leaf order.
 */
export function buildOverBoxes(boxes: Float32Array, order: Uint32Array, maxDepth: number): Tree {
  const count = order.length;
  const writer = new NodeWriter(Math.max(count - 1, 1));
  if (count < 2) {
    writer.single(leafReference(0, 1), count === 1 ? boxes.subarray(6 * (order[0] as number)) : undefined);
    return writer.finish();
  }
  const levels = new Levels(writer, { boxes, weights: new Uint32Array(boxes.length / 6).fill(1), order, count }, maxDepth, 16);
  while (levels.step(count));
  return writer.finish();
}

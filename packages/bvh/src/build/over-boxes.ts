import { leafReference } from '../layout';
import { buildLevels, counted } from './levels';
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
  const weights = new Uint32Array(boxes.length / 6).fill(1);
  const all = { boxes, weights, order };
  // One outer item that holds everything.
  buildLevels(writer, { boxes, weights, order: counted(1) }, all, Uint32Array.of(0, count), { maxLeaf: 1, maxDepth, outerDepth: maxDepth, bins: 16, leaf: (first) => leafReference(first, 1) });
  return writer.finish();
}

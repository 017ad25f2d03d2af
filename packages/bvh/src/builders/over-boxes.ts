import { leafReference } from '../layout';
import { encloseNodes, Levels } from './levels';
import { NodeWriter } from './node-writer';

/**
 * Builds over boxes by surface area heuristic, one box a leaf.
 *
 * @param boxes Six numbers each: min xyz, max xyz; finite.
 * @param writer Empty, with room for the nodes; default: one with new memory.
 * @returns The writer.
 */
export function buildOverBoxes(
  boxes: Float32Array,
  count: number,
  maxDepth: number,
  writer = new NodeWriter(Math.max(count - 1, 1)),
): NodeWriter {
  if (count < 2) writer.single(leafReference(0, 1), count === 1 ? boxes : undefined);
  else {
    new Levels(writer, { boxes, count }, maxDepth, 16).step(Infinity);
    encloseNodes(writer, 0, writer.count);
  }
  return writer;
}

import { LEAF, leafFirst, LEFT, LEFT_MAX, LEFT_MIN, NODE_WORDS, RIGHT, RIGHT_MAX, RIGHT_MIN } from '../layout';
import type { NodeWriter } from './node-writer';
import { STEP, type Steps } from './steps';

/**
 * A tree that can be changed: every item and every node has its own slot with its box. Items are 0 to n − 1,
 * nodes n to 2n − 2; n is always the root.
 */
export interface DraftTree {
  readonly itemCount: number;
  /** Six numbers a place. */
  readonly boxes: Float32Array;
  /** Half the surface of each box. */
  readonly areas: Float32Array;
  /** The places above; −1 for the root. */
  readonly parents: Int32Array;
  /** The two places below a node. */
  readonly children: Int32Array;
}

/** Half the surface of a box. */
export function boxArea(boxes: Float32Array, place: number): number {
  const b = 6 * place;
  const x = (boxes[b + 3] as number) - (boxes[b] as number),
    y = (boxes[b + 4] as number) - (boxes[b + 1] as number),
    z = (boxes[b + 5] as number) - (boxes[b + 2] as number);
  return x * y + y * z + z * x;
}

/** A draft of one item. */
export const singleDraft = (boxes: Float32Array): DraftTree => ({
  itemCount: 1,
  boxes,
  areas: new Float32Array(1),
  parents: Int32Array.of(-1),
  children: new Int32Array(2),
});

/**
 * Makes a draft of a tree over at least two items, one a leaf.
 *
 * @param order Leaf order → item.
 */
export function* draftOf({ nodes, words, count }: NodeWriter, order: Uint32Array): Steps<DraftTree> {
  const n = count + 1,
    places = 2 * n - 1;
  const boxes = new Float32Array(6 * places),
    areas = new Float32Array(places);
  const parents = new Int32Array(places),
    children = new Int32Array(2 * places);
  parents[n] = -1;
  for (let k = 0; k < 3; k++) {
    boxes[6 * n + k] = Math.min(nodes[LEFT_MIN + k] as number, nodes[RIGHT_MIN + k] as number);
    boxes[6 * n + 3 + k] = Math.max(nodes[LEFT_MAX + k] as number, nodes[RIGHT_MAX + k] as number);
  }
  areas[n] = boxArea(boxes, n);
  for (let node = 0; node < count; node++) {
    if (node % (STEP >> 1) === 0) yield node / count;
    const base = node * NODE_WORDS;
    for (let side = 0; side < 2; side++) {
      const reference = words[base + (side === 0 ? LEFT : RIGHT)] as number;
      const place = (reference & LEAF) === 0 ? n + reference : (order[leafFirst(reference)] as number);
      children[2 * (n + node) + side] = place;
      parents[place] = n + node;
      for (let k = 0; k < 3; k++) {
        boxes[6 * place + k] = nodes[base + 8 * side + k] as number;
        boxes[6 * place + 3 + k] = nodes[base + 8 * side + 4 + k] as number;
      }
      areas[place] = boxArea(boxes, place);
    }
  }
  return { itemCount: n, boxes, areas, parents, children };
}

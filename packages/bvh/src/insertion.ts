import { LEAF, LEFT, LEFT_MAX, NODE_WORDS, RIGHT, rootBounds } from './layout';

/** The slot that stands for a new root above the present one. */
export const ABOVE_ROOT = -1;
/** No slot. */
export const NOWHERE = -2;

/** Where the box of a slot begins; its upper corner lies four words on. A slot is the word of a reference. */
export const boxAt = (slot: number): number => slot - LEFT + (slot & LEFT_MAX);

/** Half the surface. */
const surface = (x: number, y: number, z: number): number => x * y + y * z + z * x;

/** Half the surface of a slot's box. */
export function surfaceAt(nodes: Float32Array, slot: number): number {
  const at = boxAt(slot);
  return surface(
    (nodes[at + 4] as number) - (nodes[at] as number),
    (nodes[at + 5] as number) - (nodes[at + 1] as number),
    (nodes[at + 6] as number) - (nodes[at + 2] as number),
  );
}

/** Half the surface of the union of a slot's box and another one, given by six numbers. */
function surfaceWith(nodes: Float32Array, slot: number, box: Float32Array): number {
  const at = boxAt(slot);
  const side = (k: number) =>
    Math.max(nodes[at + 4 + k] as number, box[3 + k] as number) - Math.min(nodes[at + k] as number, box[k] as number);
  return surface(side(0), side(1), side(2));
}

/** Half the surface of the root's box. */
export function rootSurface(nodes: Float32Array): number {
  const { min, max } = rootBounds(nodes);
  const side = (k: number) => Math.max(0, (max[k] as number) - (min[k] as number));
  return surface(side(0), side(1), side(2));
}

/** Inner nodes on the longest path down from a reference. */
export const heightOf = (heights: Uint8Array, reference: number): number =>
  reference < LEAF ? (heights[reference] as number) : 0;

/**
 * The slot where a box adds least to the surfaces, its future sibling, by branch and bound (Bittner, Hapala and Havran
 * 2013, "Fast Insertion-Based Optimization of Bounding Volume Hierarchies").
 *
 * @param heights By node: inner nodes on the longest path down, itself included.
 * @param box Six numbers.
 * @param maxDepth Maximum number of inner nodes on a path from the root, afterwards.
 * @returns {@link ABOVE_ROOT} where a new root adds least; {@link NOWHERE} where the tree would get too deep anywhere.
 */
export function bestSlot(
  nodes: Float32Array,
  words: Uint32Array,
  heights: Uint8Array,
  box: Float32Array,
  maxDepth: number,
): number {
  const own = surface(
    (box[3] as number) - (box[0] as number),
    (box[4] as number) - (box[1] as number),
    (box[5] as number) - (box[2] as number),
  );
  let best = NOWHERE,
    minimum = Infinity;
  if ((heights[0] as number) < maxDepth) {
    best = ABOVE_ROOT;
    minimum = rootSurface(nodes);
  }
  // Slots yet to visit, three numbers each: what the boxes above them grow by, inner nodes above them, the slot.
  const stack = [0, 1, RIGHT, 0, 1, LEFT];
  while (stack.length > 0) {
    const slot = stack.pop() as number,
      depth = stack.pop() as number,
      grown = stack.pop() as number;
    if (grown + own >= minimum) continue;
    const reference = words[slot] as number;
    const joined = surfaceWith(nodes, slot, box);
    if (grown + joined < minimum && depth + 1 + heightOf(heights, reference) <= maxDepth) {
      minimum = grown + joined;
      best = slot;
    }
    if (reference >= LEAF) continue;
    const below = grown + joined - surfaceAt(nodes, slot);
    if (below + own >= minimum) continue;
    const left = reference * NODE_WORDS + LEFT,
      right = reference * NODE_WORDS + RIGHT;
    const isLeftFirst =
      surfaceWith(nodes, left, box) - surfaceAt(nodes, left) <=
      surfaceWith(nodes, right, box) - surfaceAt(nodes, right);
    stack.push(below, depth + 1, isLeftFirst ? right : left, below, depth + 1, isLeftFirst ? left : right);
  }
  return best;
}

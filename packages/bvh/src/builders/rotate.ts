import { encloseChildren, LEAF } from '../layout';
import type { NodeWriter } from './node-writer';
import { STEP, type Steps } from './slices';

/** Later passes find the rotations that others have made possible. */
export const PASSES = 3;

/** Half the surface of the box around two boxes, given by the words where they start. */
function joined(n: Float32Array, a: number, b: number): number {
  const x0 = n[a] as number,
    y0 = n[a + 1] as number,
    z0 = n[a + 2] as number,
    x1 = n[a + 4] as number,
    y1 = n[a + 5] as number,
    z1 = n[a + 6] as number;
  const a0 = n[b] as number,
    b0 = n[b + 1] as number,
    c0 = n[b + 2] as number,
    a1 = n[b + 4] as number,
    b1 = n[b + 5] as number,
    c1 = n[b + 6] as number;
  const dx = (x1 > a1 ? x1 : a1) - (x0 < a0 ? x0 : a0),
    dy = (y1 > b1 ? y1 : b1) - (y0 < b0 ? y0 : b0),
    dz = (z1 > c1 ? z1 : c1) - (z0 < c0 ? z0 : c0);
  return dx * dy + dy * dz + dz * dx;
}

/**
 * Improves a tree by rotations, from the leaves up: a child changes places with a grandchild where that makes the box
 * between them smaller (Kensler 2008, "Tree Rotations for Improving Bounding Volume Hierarchies"). Afterwards parents
 * need not come before their children any more, and the tree may be deeper than before.
 */
export function* rotate({ nodes, words, count }: NodeWriter): Steps<void> {
  const order = new Uint32Array(count);
  for (let pass = 0; pass < PASSES; pass++) {
    // Parents before their children, as rotations have left them.
    const stack = [0];
    for (let i = 0; i < count; i++) {
      const node = (order[count - 1 - i] = stack.pop() as number);
      for (let at = 16 * node + 7; at > 16 * node; at -= 4)
        if ((words[at] as number) < LEAF) stack.push(words[at] as number);
    }
    for (let i = 0; i < count; i++) {
      if (i % STEP === 0) yield pass / PASSES;
      rotateAt(nodes, words, order[i] as number);
    }
  }
}

/** Improves the tree at a node. */
export function rotateAt(nodes: Float32Array, words: Uint32Array, node: number): void {
  // Words of a node: the box of a child starts at 8 × its side, its upper corner 4 later; its reference is at 3 + 4 ×
  // side.
  const INNER = 0x80000000;
  const base = 16 * node;
  let best = 0,
    side = 0,
    moved = 0;
  // The child on that side is opened; the other one may change places with either of its children.
  for (let inner = 0; inner < 2; inner++) {
    const own = base + 8 * inner;
    const opened = words[base + 3 + 4 * inner] as number;
    if (opened >= INNER) continue;
    const now = joined(nodes, own, own);
    for (let k = 0; k < 2; k++) {
      const gain = now - joined(nodes, base + 8 - 8 * inner, 16 * opened + 8 - 8 * k);
      if (gain > best) {
        best = gain;
        side = inner;
        moved = k;
      }
    }
  }
  if (best === 0) return;
  const child = 16 * (words[base + 3 + 4 * side] as number);
  const a = base + 8 - 8 * side,
    b = child + 8 * moved,
    own = base + 8 * side;
  const referenceA = base + 7 - 4 * side,
    referenceB = child + 3 + 4 * moved;
  [words[referenceA], words[referenceB]] = [words[referenceB] as number, words[referenceA] as number];
  for (const k of [0, 1, 2, 4, 5, 6]) [nodes[a + k], nodes[b + k]] = [nodes[b + k] as number, nodes[a + k] as number];
  encloseChildren(nodes, own, own + 4, child);
}

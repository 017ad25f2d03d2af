import { encloseChildren, LEAF, LEFT, NODE_WORDS, PARENT, RIGHT } from '../layout';
import type { NodeWriter, Tree } from './node-writer';

/**
 * The least height of the nodes that each pass looks at. Later passes find the rotations that others have made possible;
 * the lowest nodes are most of the work and little of the gain.
 */
const PASSES = [2, 3, 3] as const;

/** Word of the reference to the left (0) or right (1) child; the box of a child starts at word 8 × side, its upper corner 4 later. */
const reference = (side: number) => LEFT + side * (RIGHT - LEFT);

/** Half the surface of the box around two boxes, given by the words where they start. */
function joined(n: Float32Array, a: number, b: number): number {
  const x0 = n[a] as number, y0 = n[a + 1] as number, z0 = n[a + 2] as number, x1 = n[a + 4] as number, y1 = n[a + 5] as number, z1 = n[a + 6] as number;
  const a0 = n[b] as number, b0 = n[b + 1] as number, c0 = n[b + 2] as number, a1 = n[b + 4] as number, b1 = n[b + 5] as number, c1 = n[b + 6] as number;
  const dx = (x1 > a1 ? x1 : a1) - (x0 < a0 ? x0 : a0), dy = (y1 > b1 ? y1 : b1) - (y0 < b0 ? y0 : b0), dz = (z1 > c1 ? z1 : c1) - (z0 < c0 ? z0 : c0);
  return dx * dy + dy * dz + dz * dx;
}

/**
 * Improves a tree by rotations, from the leaves up: a child changes places with a grandchild where that makes the box
 * between them smaller (Kensler 2008, "Tree Rotations for Improving Bounding Volume Hierarchies"). Then puts the nodes
 * into depth-first order, parents before their children.
 *
 * @param maxDepth Most inner nodes on the way to a leaf.
 */
export function rotate({ nodes, words, count: nodeCount }: NodeWriter, maxDepth: number): Tree {
  const depths = new Uint8Array(nodeCount), heights = new Uint8Array(nodeCount);
  // Parents before their children, as rotations leave them.
  const order = new Uint32Array(nodeCount);
  const stack = new Uint32Array(maxDepth + 2);
  const height = (child: number) => ((child & LEAF) !== 0 ? 0 : (heights[child] as number));
  // Lists the nodes with at least that many levels below, and counts them.
  const arrange = (least: number) => {
    let top = 0, count = 0;
    stack[top++] = 0;
    depths[0] = 1;
    while (top > 0) {
      const node = stack[--top] as number;
      order[count++] = node;
      const depth = (depths[node] as number) + 1;
      for (let side = 1; side >= 0; side--) {
        const child = words[node * NODE_WORDS + reference(side)] as number;
        if ((child & LEAF) !== 0 || (heights[child] as number) < least) continue;
        depths[child] = depth;
        stack[top++] = child;
      }
    }
    return count;
  };
  const measureHeight = (node: number) => (heights[node] = 1 + Math.max(height(words[node * NODE_WORDS + LEFT] as number), height(words[node * NODE_WORDS + RIGHT] as number)));
  for (let node = nodeCount - 1; node >= 0; node--) measureHeight(node);
  // Swaps a child of the node at word `a` for one of the node at word `b`: reference and box.
  const exchange = (a: number, sideA: number, b: number, sideB: number) => {
    const refA = a + reference(sideA), refB = b + reference(sideB);
    const kept = words[refA] as number;
    words[refA] = words[refB] as number;
    words[refB] = kept;
    for (let k = 0; k < 7; k++) {
      if (k === 3) continue;
      const at = a + 8 * sideA + k, to = b + 8 * sideB + k;
      const value = nodes[at] as number;
      nodes[at] = nodes[to] as number;
      nodes[to] = value;
    }
  };
  for (const least of PASSES) for (let at = arrange(least) - 1; at >= 0; at--) {
    const node = order[at] as number;
    const base = node * NODE_WORDS;
    let best = 0, bestInner = 0, bestMoved = 0;
    // The child "inner" is opened; the other one may change places with either of its children.
    for (let inner = 0; inner < 2; inner++) {
      const own = base + 8 * inner, other = base + 8 * (1 - inner);
      const opened = words[base + reference(inner)] as number;
      if ((opened & LEAF) !== 0 || (depths[node] as number) + height(words[base + reference(1 - inner)] as number) + 1 > maxDepth) continue;
      const now = joined(nodes, own, own);
      for (let moved = 0; moved < 2; moved++) {
        const gain = now - joined(nodes, other, opened * NODE_WORDS + 8 * (1 - moved));
        if (gain > best) {
          best = gain;
          bestInner = inner;
          bestMoved = moved;
        }
      }
    }
    if (best > 0) {
      const opened = words[base + reference(bestInner)] as number;
      const child = opened * NODE_WORDS, own = base + 8 * bestInner;
      exchange(base, 1 - bestInner, child, bestMoved);
      encloseChildren(nodes, own, own + 4, child);
      measureHeight(opened);
    }
    measureHeight(node);
  }
  arrange(0);
  const places = new Uint32Array(nodeCount);
  for (let i = 0; i < nodeCount; i++) places[order[i] as number] = i;
  const moved = new Float32Array(nodeCount * NODE_WORDS);
  const movedWords = new Uint32Array(moved.buffer);
  for (let i = 0, to = 0; i < nodeCount; i++, to += NODE_WORDS) {
    const base = (order[i] as number) * NODE_WORDS;
    for (let k = 0; k < NODE_WORDS; k++) if (k !== PARENT) movedWords[to + k] = words[base + k] as number;
    for (let side = 0; side < 2; side++) {
      const child = words[base + reference(side)] as number;
      if ((child & LEAF) !== 0) continue;
      const place = places[child] as number;
      movedWords[to + reference(side)] = place;
      movedWords[place * NODE_WORDS + PARENT] = i;
    }
  }
  return { nodes: moved, nodeCount };
}

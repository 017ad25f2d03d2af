import { LEAF, LEFT, LEFT_MAX, LEFT_MIN, NODE_WORDS, PARENT, RIGHT, RIGHT_MAX, RIGHT_MIN } from '../layout';
import type { Tree } from './node-writer';

/** Half the surface of the box around two boxes, each given by the places of its corners. */
function joined(n: Float32Array, min: number, max: number, min2: number, max2: number): number {
  const x0 = n[min] as number, y0 = n[min + 1] as number, z0 = n[min + 2] as number, x1 = n[max] as number, y1 = n[max + 1] as number, z1 = n[max + 2] as number;
  const a0 = n[min2] as number, b0 = n[min2 + 1] as number, c0 = n[min2 + 2] as number, a1 = n[max2] as number, b1 = n[max2 + 1] as number, c1 = n[max2 + 2] as number;
  const dx = (x1 > a1 ? x1 : a1) - (x0 < a0 ? x0 : a0), dy = (y1 > b1 ? y1 : b1) - (y0 < b0 ? y0 : b0), dz = (z1 > c1 ? z1 : c1) - (z0 < c0 ? z0 : c0);
  return dx * dy + dy * dz + dz * dx;
}

function surface(n: Float32Array, min: number, max: number): number {
  const dx = (n[max] as number) - (n[min] as number), dy = (n[max + 1] as number) - (n[min + 1] as number), dz = (n[max + 2] as number) - (n[min + 2] as number);
  return dx * dy + dy * dz + dz * dx;
}

/**
 * Improves a tree by rotations, from the leaves up: a child changes places with a grandchild where that makes the box
 * between them smaller (Kensler 2008, "Tree Rotations for Improving Bounding Volume Hierarchies"). Then puts the nodes
 * into depth-first order, parents before their children.
 *
 * @param maxDepth Most inner nodes on the way to a leaf.
 */
export function rotate(tree: Tree, maxDepth: number): Tree {
  const { nodes, nodeCount } = tree;
  const words = new Uint32Array(nodes.buffer);
  const depths = new Uint8Array(nodeCount), heights = new Uint8Array(nodeCount);
  depths[0] = 1;
  for (let node = 1; node < nodeCount; node++) depths[node] = (depths[words[node * NODE_WORDS + PARENT] as number] as number) + 1;
  const height = (reference: number) => ((reference & LEAF) !== 0 ? 0 : (heights[reference] as number));
  // Swaps the child at `a` of one node for the child at `b` of another: reference and box.
  const exchange = (refA: number, minA: number, maxA: number, refB: number, minB: number, maxB: number) => {
    const reference = words[refA] as number;
    words[refA] = words[refB] as number;
    words[refB] = reference;
    for (let k = 0; k < 3; k++) {
      const low = nodes[minA + k] as number, high = nodes[maxA + k] as number;
      nodes[minA + k] = nodes[minB + k] as number;
      nodes[maxA + k] = nodes[maxB + k] as number;
      nodes[minB + k] = low;
      nodes[maxB + k] = high;
    }
  };
  const enclose = (min: number, max: number, child: number) => {
    for (let k = 0; k < 3; k++) {
      nodes[min + k] = Math.min(nodes[child + LEFT_MIN + k] as number, nodes[child + RIGHT_MIN + k] as number);
      nodes[max + k] = Math.max(nodes[child + LEFT_MAX + k] as number, nodes[child + RIGHT_MAX + k] as number);
    }
  };
  for (let node = nodeCount - 1; node >= 0; node--) {
    const base = node * NODE_WORDS;
    const left = words[base + LEFT] as number, right = words[base + RIGHT] as number;
    const leftHeight = height(left), rightHeight = height(right);
    heights[node] = 1 + Math.max(leftHeight, rightHeight);
    const room = maxDepth - (depths[node] as number) + 1;
    let best = 0, choice = 0;
    if ((right & LEAF) === 0 && leftHeight + 2 <= room) {
      const child = right * NODE_WORDS;
      const now = surface(nodes, base + RIGHT_MIN, base + RIGHT_MAX);
      const a = now - joined(nodes, base + LEFT_MIN, base + LEFT_MAX, child + RIGHT_MIN, child + RIGHT_MAX);
      const b = now - joined(nodes, base + LEFT_MIN, base + LEFT_MAX, child + LEFT_MIN, child + LEFT_MAX);
      if (a > best) {
        best = a;
        choice = 1;
      }
      if (b > best) {
        best = b;
        choice = 2;
      }
    }
    if ((left & LEAF) === 0 && rightHeight + 2 <= room) {
      const child = left * NODE_WORDS;
      const now = surface(nodes, base + LEFT_MIN, base + LEFT_MAX);
      const a = now - joined(nodes, base + RIGHT_MIN, base + RIGHT_MAX, child + RIGHT_MIN, child + RIGHT_MAX);
      const b = now - joined(nodes, base + RIGHT_MIN, base + RIGHT_MAX, child + LEFT_MIN, child + LEFT_MAX);
      if (a > best) {
        best = a;
        choice = 3;
      }
      if (b > best) {
        best = b;
        choice = 4;
      }
    }
    if (choice === 0) continue;
    const inner = choice < 3 ? right : left;
    const child = inner * NODE_WORDS;
    const [ref, min, max] = choice < 3 ? [LEFT, LEFT_MIN, LEFT_MAX] : [RIGHT, RIGHT_MIN, RIGHT_MAX];
    if (choice % 2 === 1) exchange(base + ref, base + min, base + max, child + LEFT, child + LEFT_MIN, child + LEFT_MAX);
    else exchange(base + ref, base + min, base + max, child + RIGHT, child + RIGHT_MIN, child + RIGHT_MAX);
    if (choice < 3) enclose(base + RIGHT_MIN, base + RIGHT_MAX, child);
    else enclose(base + LEFT_MIN, base + LEFT_MAX, child);
    heights[inner] = 1 + Math.max(height(words[child + LEFT] as number), height(words[child + RIGHT] as number));
    heights[node] = 1 + Math.max(height(words[base + LEFT] as number), height(words[base + RIGHT] as number));
  }
  return depthFirst(tree, maxDepth);
}

/** The same tree with its nodes in depth-first order. */
function depthFirst({ nodes, nodeCount }: Tree, maxDepth: number): Tree {
  const words = new Uint32Array(nodes.buffer);
  const moved = new Float32Array(nodeCount * NODE_WORDS);
  const movedWords = new Uint32Array(moved.buffer);
  // Pending nodes, and the word of the moved parent that names each.
  const stack = new Uint32Array(2 * (maxDepth + 2));
  let top = 0, count = 0;
  const put = (node: number, parent: number) => {
    const from = node * NODE_WORDS, to = count * NODE_WORDS;
    for (let k = 0; k < NODE_WORDS; k++) movedWords[to + k] = words[from + k] as number;
    movedWords[to + PARENT] = parent;
    return count++;
  };
  const visit = (node: number, parent: number) => {
    const at = put(node, parent) * NODE_WORDS;
    if (((movedWords[at + RIGHT] as number) & LEAF) === 0) {
      stack[top++] = movedWords[at + RIGHT] as number;
      stack[top++] = at + RIGHT;
    }
    if (((movedWords[at + LEFT] as number) & LEAF) === 0) {
      stack[top++] = movedWords[at + LEFT] as number;
      stack[top++] = at + LEFT;
    }
  };
  visit(0, 0);
  while (top > 0) {
    const slot = stack[--top] as number;
    const node = stack[--top] as number;
    movedWords[slot] = count;
    visit(node, Math.floor(slot / NODE_WORDS));
  }
  return { nodes: moved, nodeCount };
}

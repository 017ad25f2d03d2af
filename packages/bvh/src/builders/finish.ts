import { leafReference, LEFT, NODE_WORDS, RIGHT } from '../layout';
import { boxArea, type DraftTree } from './draft';
import { NodeWriter } from './node-writer';
import { PAIR } from './primitives';
import type { References } from './references';
import { keepNodes, part, STEP, type Steps, type TriangleTree } from './steps';

/** The place of the root. */
const rootOf = ({ itemCount }: DraftTree) => (itemCount > 1 ? itemCount : 0);

/** All nodes, parents before their children. */
function* topDown(tree: DraftTree): Steps<Uint32Array> {
  const { itemCount, children } = tree;
  const order = new Uint32Array(Math.max(0, itemCount - 1));
  let end = 0;
  if (itemCount > 1) order[end++] = rootOf(tree);
  for (let i = 0; i < end; i++) {
    const at = 2 * (order[i] as number);
    const left = children[at] as number,
      right = children[at + 1] as number;
    if (left >= itemCount) order[end++] = left;
    if (right >= itemCount) order[end++] = right;
    if (i % STEP === 0) yield 0;
  }
  return order;
}

/** Rebuilds the subtree of a node by joining neighbours: the minimum height. */
function flatten({ itemCount, boxes, areas, parents, children }: DraftTree, root: number): void {
  const items: number[] = [],
    nodes: number[] = [],
    pending = [root];
  while (pending.length > 0) {
    const place = pending.pop() as number;
    if (place < itemCount) items.push(place);
    else {
      nodes.push(place);
      pending.push(children[2 * place + 1] as number, children[2 * place] as number);
    }
  }
  // The last to be used is the root.
  for (let list = items; list.length > 1;) {
    const next: number[] = [];
    for (let i = 0; i < list.length; i += 2) {
      const left = list[i] as number,
        right = list[i + 1];
      if (right === undefined) {
        next.push(left);
        continue;
      }
      const node = nodes.pop() as number;
      children[2 * node] = left;
      children[2 * node + 1] = right;
      parents[left] = parents[right] = node;
      for (let k = 0; k < 3; k++) {
        boxes[6 * node + k] = Math.min(boxes[6 * left + k] as number, boxes[6 * right + k] as number);
        boxes[6 * node + 3 + k] = Math.max(boxes[6 * left + 3 + k] as number, boxes[6 * right + 3 + k] as number);
      }
      areas[node] = boxArea(boxes, node);
      next.push(node);
    }
    list = next;
  }
}

/** Ensures that no path from the root has more than `maxDepth` nodes. */
export function* boundDepth(tree: DraftTree, maxDepth: number): Steps<void> {
  const { itemCount, children, parents } = tree;
  const order = yield* topDown(tree);
  const places = 2 * itemCount - 1;
  const depths = new Uint32Array(places),
    heights = new Uint32Array(places),
    items = new Uint32Array(places).fill(1, 0, itemCount);
  for (let i = order.length - 1; i >= 0; i--) {
    const node = order[i] as number;
    const left = children[2 * node] as number,
      right = children[2 * node + 1] as number;
    heights[node] = 1 + Math.max(heights[left] as number, heights[right] as number);
    items[node] = (items[left] as number) + (items[right] as number);
    if (i % STEP === 0) yield 0;
  }
  if ((heights[rootOf(tree)] as number) <= maxDepth) return;
  const settled = new Uint8Array(places);
  const min = (place: number) => 32 - Math.clz32((items[place] as number) - 1);
  for (const [i, node] of order.entries()) {
    const parent = parents[node] as number;
    const depth = parent < 0 ? 0 : (depths[parent] as number) + 1;
    depths[node] = depth;
    if (parent >= 0 && settled[parent] === 1) settled[node] = 1;
    else if (depth + (heights[node] as number) <= maxDepth) settled[node] = 1;
    else if (
      depth + 1 + Math.max(min(children[2 * node] as number), min(children[2 * node + 1] as number)) >
      maxDepth
    ) {
      flatten(tree, node);
      settled[node] = 1;
    }
    if (i % STEP === 0) yield 0;
  }
}

/**
 * Turns a draft into nodes, depth first, with leaves where they cost less than splitting. Pieces of one triangle in one
 * leaf become one.
 */
export function* finishDraft(
  tree: DraftTree,
  { triangles }: References,
  maxLeaf: number,
  maxDepth: number,
): Steps<Omit<TriangleTree, 'bounds'>> {
  const { itemCount, boxes, areas, children } = tree;
  const places = 2 * itemCount - 1;
  yield* boundDepth(tree, maxDepth);
  const order = yield* topDown(tree);
  const weights = new Uint32Array(places),
    costs = new Float64Array(places),
    leaf = new Uint8Array(places).fill(1);
  for (let i = 0; i < itemCount; i++) {
    weights[i] = (triangles[i] as number) >= PAIR ? 2 : 1;
    costs[i] = (areas[i] as number) * (weights[i] as number);
    if (i % STEP === 0) yield 0;
  }
  let nodeCount = 0;
  for (let i = order.length - 1; i >= 0; i--) {
    const node = order[i] as number;
    const left = children[2 * node] as number,
      right = children[2 * node + 1] as number;
    const weight = (weights[left] as number) + (weights[right] as number);
    const area = areas[node] as number;
    const cost = area + (costs[left] as number) + (costs[right] as number);
    const together = weight <= maxLeaf && area * weight <= cost;
    weights[node] = weight;
    costs[node] = together ? area * weight : cost;
    leaf[node] = together ? 1 : 0;
    nodeCount++;
    if (i % STEP === 0) yield 0.3;
  }
  const root = rootOf(tree);
  const writer = new NodeWriter(Math.max(1, nodeCount));
  const triangleIndices = new Uint32Array(weights[root] as number);
  let emitted = 0;
  const below = new Int32Array(2 * maxLeaf + 2);
  const put = (start: number, triangle: number) => {
    for (let i = start; i < emitted; i++) if (triangleIndices[i] === triangle) return;
    triangleIndices[emitted++] = triangle;
  };
  const emit = (place: number): number => {
    const start = emitted;
    below[0] = place;
    for (let top = 1; top > 0;) {
      const at = below[--top] as number;
      if (at >= itemCount) {
        below[top++] = children[2 * at + 1] as number;
        below[top++] = children[2 * at] as number;
        continue;
      }
      const first = triangles[at] as number;
      put(start, first & (PAIR - 1));
      if (first >= PAIR) put(start, (first & (PAIR - 1)) + 1);
    }
    return leafReference(start, emitted - start);
  };
  if (leaf[root] === 1) {
    writer.single(emit(root), boxes.subarray(6 * root, 6 * root + 6));
    return { ...writer.finish(), triangleIndices: triangleIndices.slice(0, emitted) };
  }
  // Places, and the words for the references to them.
  const pending = new Uint32Array(2 * (maxDepth + 2));
  pending[0] = root;
  for (let top = 1, visited = 0; top > 0; visited++) {
    const p = 2 * --top;
    const place = pending[p] as number,
      slot = pending[p + 1] as number;
    let reference: number;
    if (leaf[place] === 1) reference = emit(place);
    else {
      reference = writer.under(slot);
      for (let k = 1; k >= 0; k--) {
        const q = 2 * top++;
        pending[q] = children[2 * place + k] as number;
        pending[q + 1] = reference * NODE_WORDS + (k === 1 ? RIGHT : LEFT);
      }
    }
    if (slot > 0) writer.put(slot, reference, boxes, 6 * place);
    if (visited % STEP === 0) yield 0.5 + (0.5 * writer.count) / nodeCount;
  }
  const { nodes, nodeCount: kept } = yield* part(keepNodes(writer), 1, 1);
  return {
    nodes,
    nodeCount: kept,
    triangleIndices: emitted === triangleIndices.length ? triangleIndices : triangleIndices.slice(0, emitted),
  };
}

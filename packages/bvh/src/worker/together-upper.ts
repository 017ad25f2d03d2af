import { GROUP_MAX } from '../build/agglomerate';
import type { Clusters } from '../build/clusters';
import { encloseNodes, type Levels } from '../build/levels';
import type { NodeWriter } from '../build/node-writer';
import { PASSES, rotateAt } from '../build/rotate';
import { LEAF, leafFirst, LEFT, NODE_WORDS, PARENT, RIGHT } from '../layout';
import type { Team } from './team';

/** Numbers of a pending range of {@link Levels}; its first and end lie at the 6th and 7th place, the word for its reference at the 8th. */
const TASK = 10;
/** Ranges that the upper levels are cut into before they are shared out. */
const SHARES = 12;

/**
 * Builds the upper levels, each its part: nodes get the places that they have when one worker does all, depth first. The
 * first cuts both into parts, so that neither waits.
 */
export function shareLevels(levels: Levels, upper: NodeWriter, team: Team): void {
  const { tasks } = levels;
  const size = (task: readonly number[]) => (task[7] as number) - (task[6] as number);
  const pending: { task: number[]; node: number }[] = [{ task: tasks.splice(0), node: 0 }];
  const tops: number[] = [];
  while (pending.length < SHARES) {
    const largest = pending.reduce((best, { task }, i) => (size(task) > size((pending[best] as (typeof pending)[0]).task) ? i : best), 0);
    const { task, node } = pending[largest] as (typeof pending)[0];
    if (size(task) <= GROUP_MAX) break;
    tasks.push(...task);
    upper.count = node;
    tops.push(node);
    levels.step(1);
    const right = tasks.splice(0, TASK), left = tasks.splice(0);
    // Depth first: all the nodes of the left side come before the right one's.
    pending.splice(largest, 1, { task: left, node: node + 1 }, { task: right, node: node + size(left) });
  }
  const all = pending.reduce((sum, { task }) => sum + size(task), 0);
  let before = 0;
  for (const { task, node } of pending) {
    const mine = (before + size(task) / 2 < all / 2 ? 0 : 1) === team.index;
    before += size(task);
    if (!mine) continue;
    tasks.push(...task);
    upper.count = node;
    while (levels.step(Infinity));
    encloseNodes(upper, node, node + size(task) - 1);
  }
  team.meet();
  upper.count = all - 1;
  if (team.index === 0) for (const node of tops.sort((a, b) => b - a)) encloseNodes(upper, node, node + 1);
  team.meet();
}

/** The nodes as the walk depth first meets them, the last one first. */
function backwards({ words, count }: NodeWriter, order: Uint32Array): void {
  const stack = [0];
  for (let i = count - 1; i >= 0; i--) {
    const node = (order[i] = stack.pop() as number), base = node * NODE_WORDS;
    const left = words[base + LEFT] as number, right = words[base + RIGHT] as number;
    if (right < LEAF) stack.push(right);
    if (left < LEAF) stack.push(left);
  }
}

/**
 * The rotations of `rotate`, with the same outcome. What the walk meets last hangs on nothing that it meets before but on
 * the nodes above the border: the second does the last half, the first the other one, and then those nodes.
 */
export function shareRotations(upper: NodeWriter, team: Team): void {
  const { nodes, words, count } = upper;
  const order = new Uint32Array(count), middle = count >>> 1;
  for (let pass = 0; pass < PASSES; pass++) {
    backwards(upper, order);
    // Both have walked before either turns anything.
    team.meet();
    const above: number[] = [];
    if (team.index === 1) for (let i = 0; i < middle; i++) rotateAt(nodes, words, order[i] as number);
    else {
      let open = middle > 0 ? (order[middle - 1] as number) : -1;
      for (let i = middle; i < count; i++) {
        const node = order[i] as number, base = node * NODE_WORDS;
        if (words[base + LEFT] === open || words[base + RIGHT] === open) above.push((open = node));
        else rotateAt(nodes, words, node);
      }
    }
    team.meet();
    for (const node of above) rotateAt(nodes, words, node);
    team.meet();
  }
}

/**
 * Puts the nodes over the clusters before the others, depth first, as `crown` does, each one's half of them.
 *
 * @returns Their depth; nothing is written where it is more than `maxDepth`.
 */
export function shareCrown(upper: NodeWriter, { references }: Clusters, { nodes, words }: NodeWriter, maxDepth: number, team: Team): number {
  const { count, nodes: from, words: fromWords } = upper;
  const order = new Uint32Array(count), places = new Uint32Array(count), parents = new Uint32Array(count), depths = new Uint16Array(count);
  const stack = [0, 0];
  let most = 0;
  for (let place = 0; place < count; place++) {
    const parent = stack.pop() as number, node = stack.pop() as number, base = node * NODE_WORDS;
    order[place] = node;
    places[node] = place;
    parents[place] = parent;
    const depth = (depths[place] = place === 0 ? 1 : (depths[parent] as number) + 1);
    if (depth > most) most = depth;
    const left = fromWords[base + LEFT] as number, right = fromWords[base + RIGHT] as number;
    if (right < LEAF) stack.push(right, place);
    if (left < LEAF) stack.push(left, place);
  }
  if (most > maxDepth) return most;
  const [first, end] = team.index === 0 ? [0, count >>> 1] : [count >>> 1, count];
  for (let place = first; place < end; place++) {
    const a = (order[place] as number) * NODE_WORDS, b = place * NODE_WORDS;
    for (let k = 0; k < NODE_WORDS; k++) nodes[b + k] = from[a + k] as number;
    words[b + PARENT] = parents[place] as number;
    for (const side of [LEFT, RIGHT]) {
      let reference = fromWords[a + side] as number;
      if (reference < LEAF) reference = places[reference] as number;
      else {
        reference = references[leafFirst(reference)] as number;
        if (reference < LEAF) words[reference * NODE_WORDS + PARENT] = place;
      }
      words[b + side] = reference;
    }
  }
  team.meet();
  return most;
}

import { GROUP_MAX } from '../builders/agglomerate';
import type { Clusters } from '../builders/clusters';
import { encloseNodes, Levels, type Items } from '../builders/levels';
import type { NodeWriter } from '../builders/node-writer';
import { PASSES, rotateAt } from '../builders/rotate';
import { LEAF, LEFT, NODE_WORDS, RIGHT } from '../layout';
import type { Team } from './team';

/** Numbers of a pending range of {@link Levels}; its first and end lie at the 6th and 7th place. */
const TASK = 10;
/** Ranges that the upper levels are cut into before they are distributed. */
const SHARES = 24;

/**
 * Builds the upper levels: nodes get the positions that a single worker gives them, depth first. The second worker cuts
 * ranges, while the first does something else; then each takes the largest one left when it is free.
 *
 * @param meanwhile What the first worker does before it joins.
 * @returns The result of `meanwhile`; undefined in the second worker.
 */
export function shareLevels<T>(
  upper: NodeWriter,
  clusters: Clusters,
  maxDepth: number,
  bins: number,
  team: Team,
  meanwhile: () => T,
): T | undefined {
  const { count } = clusters;
  const words = team.int32(4 * count),
    shares = team.int32((TASK + 1) * SHARES + 1);
  const levelsOver = (items: Items) => new Levels(upper, items, maxDepth, bins, words);
  let levels: Levels;
  let result: T | undefined;
  let tops: number[] = [];
  if (team.index === 1) {
    levels = levelsOver(clusters);
    tops = cutShares(levels, upper, shares);
    team.publish();
  } else {
    // Without items: it works on the ranges that the other worker has cut.
    levels = levelsOver({ ...clusters, count: 0 });
    levels.tasks.length = 0;
    result = meanwhile();
    team.published();
  }
  for (let share = team.take(3); share < (shares[0] as number); share = team.take(3)) {
    const [node, ...task] = shares.subarray(
      (TASK + 1) * share + 1,
      (TASK + 1) * (share + 1) + 1,
    ) as unknown as number[];
    levels.tasks.push(...task);
    upper.count = node as number;
    while (levels.step(Infinity));
    encloseNodes(upper, node as number, upper.count);
  }
  team.meet();
  upper.count = count - 1;
  // No one reads boxes before the next barrier.
  for (const node of tops) encloseNodes(upper, node, node + 1);
  return result;
}

/**
 * Cuts the whole into ranges and writes their number, then for each its first node and its task, the largest first.
 *
 * @returns The nodes above them, children first.
 */
function cutShares(levels: Levels, upper: NodeWriter, shares: Int32Array): number[] {
  const { tasks } = levels;
  const size = (task: readonly number[]) => (task[7] as number) - (task[6] as number);
  const pending: { task: number[]; node: number }[] = [{ task: tasks.splice(0), node: 0 }];
  const tops: number[] = [];
  while (pending.length < SHARES) {
    const largest = pending.reduce(
      (best, { task }, i) => (size(task) > size((pending[best] as (typeof pending)[0]).task) ? i : best),
      0,
    );
    const { task, node } = pending[largest] as (typeof pending)[0];
    if (size(task) <= GROUP_MAX) break;
    tasks.push(...task);
    upper.count = node;
    tops.push(node);
    levels.step(1);
    const right = tasks.splice(0, TASK),
      left = tasks.splice(0);
    // Depth first: all the nodes of the left side come before the right one's.
    pending.splice(largest, 1, { task: left, node: node + 1 }, { task: right, node: node + size(left) });
  }
  pending.sort((a, b) => size(b.task) - size(a.task));
  shares[0] = pending.length;
  shares.set(
    pending.flatMap(({ task, node }) => [node, ...task]),
    1,
  );
  return tops.sort((a, b) => b - a);
}

/** The nodes in reverse depth-first order. */
function backwards(words: Uint32Array, order: Uint32Array): void {
  const stack = [0];
  for (let i = order.length - 1; i >= 0; i--) {
    const node = (order[i] = stack.pop() as number);
    for (const at of [RIGHT, LEFT]) {
      const child = words[node * NODE_WORDS + at] as number;
      if (child < LEAF) stack.push(child);
    }
  }
}

/**
 * The rotations of `rotate`, with the same result: any order with children before their parents gives it, at first the
 * reverse of the order of writing. The second worker does the last half of the nodes, which depend on no node before
 * them; the first does the other half, except those that depend on the last half: these wait.
 */
export function shareRotations({ nodes, words, count }: NodeWriter, team: Team): void {
  const order = new Uint32Array(count).map((_, i) => count - 1 - i),
    middle = count >>> 1;
  /** Whether a node is in the first half and depends on none of the last. */
  const free = new Uint8Array(count);
  for (let pass = 0; pass < PASSES; pass++) {
    if (pass > 0) backwards(words, order);
    // Both have the order, and all boxes are written, before either rotates anything.
    team.meet();
    const waiting: number[] = [];
    if (team.index === 1) for (let i = 0; i < middle; i++) rotateAt(nodes, words, order[i] as number);
    else {
      free.fill(0);
      for (let i = middle; i < count; i++) {
        const node = order[i] as number,
          left = words[node * NODE_WORDS + LEFT] as number,
          right = words[node * NODE_WORDS + RIGHT] as number;
        if ((left < LEAF && free[left] === 0) || (right < LEAF && free[right] === 0)) waiting.push(node);
        else {
          free[node] = 1;
          rotateAt(nodes, words, node);
        }
      }
    }
    team.meet();
    for (const node of waiting) rotateAt(nodes, words, node);
    team.meet();
  }
}

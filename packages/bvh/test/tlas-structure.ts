import { expect } from 'vitest';
import type { DynamicTlas } from '../src/dynamic-tlas';
import { buildTlas, TLAS_MAX_DEPTH, type Aabb, type TlasInstance } from '../src/index';
import { FAR, LEAF, LEFT, leafCount, leafFirst, NODE_WORDS, PARENT, RIGHT } from '../src/layout';
import { affine } from './shapes';

export type Placing = TlasInstance | undefined;

/** A uniform scale at a place. */
export const at = (x: number, y: number, z: number, size = 1) => [
  size,
  0,
  0,
  0,
  0,
  size,
  0,
  0,
  0,
  0,
  size,
  0,
  x,
  y,
  z,
  1,
];

const NOWHERE: Aabb = { min: new Float32Array(3), max: new Float32Array(3) };

/**
 * Checks all that traversals and later updates rely on: each instance is in one leaf, boxes fit tightly, parents are
 * named.
 */
export function checkTlas(tlas: DynamicTlas, placings: readonly Placing[]): void {
  const { nodes, nodeCount } = tlas;
  const words = new Uint32Array(nodes.buffer, nodes.byteOffset, nodes.length);
  expect(nodes.length).toBe(nodeCount * NODE_WORDS);
  const expected = buildTlas(
    placings.map((placing) => placing ?? { bounds: NOWHERE, transform: [NaN, ...at(0, 0, 0).slice(1)] }),
  );
  const present = [...expected.instanceOrder];
  expect(tlas.count).toBe(present.length);
  const inTree = new Set(present);
  placings.forEach((_, i) => tlas.has(i) === inTree.has(i) || expect.fail(`instance ${i}`));
  expect(nodeCount).toBe(Math.max(1, present.length - 1));
  expect(tlas.bounds).toEqual(expected.bounds);
  const seen: number[] = [];
  let visited = 0;
  const walk = (node: number, parent: number, depth: number): number[] => {
    visited++;
    if (depth > TLAS_MAX_DEPTH || words[node * NODE_WORDS + PARENT] !== parent)
      expect.fail(`node ${node}: depth ${depth}, below ${parent}`);
    const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
    for (const side of [LEFT, RIGHT]) {
      const low = node * NODE_WORDS + (side === LEFT ? 0 : 8);
      if (nodes[low] === FAR) continue;
      const own = [...nodes.subarray(low, low + 3), ...nodes.subarray(low + 4, low + 7)];
      const reference = words[node * NODE_WORDS + side]!;
      if (reference >= LEAF) {
        if (leafCount(reference) !== 1) expect.fail('a leaf of several');
        seen.push(leafFirst(reference));
      } else if (walk(reference, node, depth + 1).some((x, k) => x !== own[k]))
        expect.fail(`the box of node ${reference} is not that of its children`);
      for (let k = 0; k < 3; k++) {
        box[k] = Math.min(box[k]!, own[k]!);
        box[3 + k] = Math.max(box[3 + k]!, own[3 + k]!);
      }
    }
    return box;
  };
  walk(0, 0, 1);
  expect(visited).toBe(nodeCount);
  expect(seen.sort((a, b) => a - b)).toEqual(present);
  for (const i of present)
    for (let k = 12 * i; k < 12 * i + 12; k++)
      if (tlas.toObject[k] !== expected.toObject[k]) expect.fail(`toObject of instance ${i}`);
}

/** Moves, adds and removes instances, mostly one at a time, and checks the tree after each. */
export function changeAtRandom(
  tlas: DynamicTlas,
  placings: Placing[],
  { bounds, random, turns }: { readonly bounds: Aabb; readonly random: () => number; readonly turns: number },
): void {
  const count = placings.length;
  const placed = (transform: ArrayLike<number>): TlasInstance => ({ bounds, transform });
  for (let turn = 0; turn < turns && count > 0; turn++) {
    const changes = Array.from({ length: random() < 0.1 ? Math.ceil(random() * count) : 1 }, () => {
      const i = Math.floor(random() * count),
        kind = random();
      const before = placings[i];
      if (kind < 0.3) placings[i] = undefined;
      else if (kind < 0.35) placings[i] = placed(at(0, 0, 0, 0));
      else if (kind < 0.6 && before)
        placings[i] = placed(
          Array.from(before.transform, (x, k) => x + (k >= 12 && k < 15 ? 0.05 * (random() - 0.5) : 0)),
        );
      else placings[i] = placed(affine(random, 5));
      return [i, placings[i]] as const;
    });
    tlas.update(changes);
    checkTlas(tlas, placings);
  }
}

import { expect, test } from 'vitest';
import { buildTlas } from '../../src/index';
import { LEAF, leafFirst, LEFT, NODE_WORDS, RIGHT } from '../../src/layout';
import { direction, randomNumbers } from '../shapes';

const unit = { min: new Float32Array([-0.1, -0.1, -0.1]), max: new Float32Array([0.1, 0.1, 0.1]) };
const at = (x: number, y: number, z: number) => ({
  bounds: unit,
  transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1],
});

/** Sum of the surfaces of all boxes, and how many instances lie under the root's children, fewest first. */
function measure({ nodes, nodeCount }: { nodes: Float32Array<ArrayBuffer>; nodeCount: number }) {
  const words = new Uint32Array(nodes.buffer);
  let surface = 0;
  for (let at = 0; at < nodeCount * NODE_WORDS; at += 8) {
    const [x, y, z] = [0, 1, 2].map((k) => nodes[at + 4 + k]! - nodes[at + k]!) as [number, number, number];
    surface += x * y + y * z + z * x;
  }
  const count = (reference: number): number =>
    (reference & LEAF) !== 0
      ? 1
      : count(words[reference * NODE_WORDS + LEFT]!) + count(words[reference * NODE_WORDS + RIGHT]!);
  return { surface, sides: [count(words[LEFT]!), count(words[RIGHT]!)].sort((a, b) => a - b) };
}

test('a crowd of small things far from another is separated as well as by itself (seed 41)', () => {
  const random = randomNumbers(41);
  // In steps of 2^-15 of the whole the crowd would be a point.
  const crowd = Array.from({ length: 1000 }, () => direction(random).map((x) => 4 * x * random()));
  const alone = measure(buildTlas(crowd.map(([x, y, z]) => at(x!, y!, z!))));
  const together = buildTlas([...crowd.map(([x, y, z]) => at(x!, y!, z!)), at(100_000, 0, 0)]);
  const { surface, sides } = measure(together);
  expect(sides).toEqual([1, 1000]);
  // The root's two boxes aside, the tree is that of the crowd, up to how steps fall and what rounding adds to boxes.
  expect(surface).toBeLessThan(1.02 * alone.surface + 1000);
  const words = new Uint32Array(together.nodes.buffer);
  const reached = new Set<number>();
  for (let node = 0; node < together.nodeCount; node++)
    for (const side of [LEFT, RIGHT])
      if ((words[node * NODE_WORDS + side]! & LEAF) !== 0)
        reached.add(together.instanceOrder[leafFirst(words[node * NODE_WORDS + side]!)]!);
  expect(reached.size).toBe(1001);
});

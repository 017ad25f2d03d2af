import { expect, test } from 'vitest';
import { buildOverBoxes } from '../../src/builders/over-boxes';
import { buildTlas } from '../../src/index';
import { LEAF, leafFirst, LEFT, NODE_WORDS, RIGHT } from '../../src/layout';
import { direction, randomNumbers } from '../shapes';
import { checkStructure } from '../structure';

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

/** Sum of the surfaces of all boxes below one around a range, halved at the median of its longest axis. */
function medianSurface(boxes: readonly (readonly number[])[]): number {
  if (boxes.length === 1) return 0;
  const extents = [0, 1, 2].map((k) => Math.max(...boxes.map((b) => b[3 + k]!)) - Math.min(...boxes.map((b) => b[k]!)));
  const axis = extents.indexOf(Math.max(...extents));
  const sorted = [...boxes].sort((a, b) => a[axis]! + a[3 + axis]! - b[axis]! - b[3 + axis]!);
  const middle = Math.ceil(boxes.length / 2);
  return [sorted.slice(0, middle), sorted.slice(middle)].reduce((sum, side) => {
    const [x, y, z] = [0, 1, 2].map(
      (k) => Math.max(...side.map((b) => b[3 + k]!)) - Math.min(...side.map((b) => b[k]!)),
    );
    return sum + x! * y! + y! * z! + z! * x! + medianSurface(side);
  }, 0);
}

for (const [what, power] of [
  ['strewn evenly', 1],
  ['crowded towards a corner', 4],
] as const)
  for (const count of [100, 1000, 1024])
    test(`with few levels to spare, ${count} boxes ${what} are split better than at medians (seed 42)`, () => {
      const random = randomNumbers(42);
      const boxes = Array.from({ length: count }, () => {
        const low = [0, 1, 2].map(() => random() ** power);
        return Array.from(new Float32Array([...low, ...low.map((x) => x + 0.05 * random())]));
      });
      const medians = medianSurface(boxes);
      const needed = Math.ceil(Math.log2(count));
      for (let maxDepth = needed; maxDepth < needed + 4; maxDepth++) {
        const tree = buildOverBoxes(new Float32Array(boxes.flat()), count, maxDepth).finish();
        checkStructure(tree, count, (i) => boxes[i]!, 1, maxDepth);
        expect(measure(tree).surface).toBeLessThan(medians);
      }
    });

test('no tree is deeper than allowed: equal centres, sizes that double (seed 43)', () => {
  const random = randomNumbers(43);
  for (let count = 2; count <= 200; count = Math.ceil(1.3 * count)) {
    for (const place of [() => Math.floor(3 * random()), (i: number) => 2 ** (i % 120) * random()]) {
      const boxes = Array.from({ length: count }, (_, i) => {
        const low = [0, 1, 2].map(() => place(i));
        return Array.from(new Float32Array([...low, ...low.map((x) => 1.5 * x)]));
      });
      for (let maxDepth = Math.ceil(Math.log2(count)); maxDepth < 12; maxDepth++)
        checkStructure(
          buildOverBoxes(new Float32Array(boxes.flat()), count, maxDepth).finish(),
          count,
          (i) => boxes[i]!,
          1,
          maxDepth,
        );
    }
  }
});

import { expect, test } from 'vitest';
import { Agglomerator, GROUP_MAX } from '../../src/builders/agglomerate';
import { randomNumbers } from '../shapes';

/** Walks the tree: every item once, boxes around their children's. Gives the height and the surface of all nodes. */
function check(group: Agglomerator, count: number): { height: number; surface: number } {
  const { boxes, children } = group;
  const seen = new Set<number>();
  let surface = 0;
  const walk = (id: number): number => {
    if (id < count) {
      expect(seen.has(id)).toBe(false);
      seen.add(id);
      return 0;
    }
    const heights = [0, 1].map((side) => {
      const child = children[2 * id + side]!;
      expect(child).toBeLessThan(id);
      for (let k = 0; k < 3; k++) {
        expect(boxes[6 * child + k]).toBeGreaterThanOrEqual(boxes[6 * id + k]!);
        expect(boxes[6 * child + 3 + k]).toBeLessThanOrEqual(boxes[6 * id + 3 + k]!);
      }
      return walk(child);
    });
    const [x, y, z] = [0, 1, 2].map((k) => boxes[6 * id + 3 + k]! - boxes[6 * id + k]!) as [number, number, number];
    surface += x * y + y * z + z * x;
    return 1 + Math.max(...heights);
  };
  const height = walk(2 * count - 2);
  expect(seen.size).toBe(count);
  return { height, surface };
}

const fill = (group: Agglomerator, count: number, random: () => number, size = 0.2) => {
  for (let i = 0; i < count; i++) {
    for (let k = 0; k < 3; k++) {
      const at = random();
      group.boxes[6 * i + k] = at;
      group.boxes[6 * i + 3 + k] = at + size * random();
    }
  }
};

for (const seed of [1, 2, 3]) {
  test(`makes trees of any number of boxes, within the height allowed (seed ${seed})`, () => {
    const random = randomNumbers(seed),
      group = new Agglomerator(0);
    for (let count = 1; count <= GROUP_MAX; count++) {
      fill(group, count, random);
      const min = Math.ceil(Math.log2(count));
      for (const height of [min, min + 1, 15]) {
        if (group.run(count) > height) group.run(count, true);
        expect(check(group, count).height).toBeLessThanOrEqual(height);
      }
    }
  });
}

test('is as good as merging the two nearest boxes over and over, in double precision (seed 4)', () => {
  const random = randomNumbers(4),
    group = new Agglomerator(0);
  let ours = 0,
    greedy = 0;
  for (let round = 0; round < 100; round++) {
    fill(group, 16, random);
    let list = Array.from({ length: 16 }, (_, i) => [...group.boxes.subarray(6 * i, 6 * i + 6)]);
    const union = (a: number[], b: number[]) => a.map((x, k) => (k < 3 ? Math.min(x, b[k]!) : Math.max(x, b[k]!)));
    const area = ([a, b, c, x, y, z]: number[]) =>
      (x! - a!) * (y! - b!) + (y! - b!) * (z! - c!) + (z! - c!) * (x! - a!);
    while (list.length > 1) {
      let best = Infinity,
        pair = [0, 1];
      list.forEach((a, i) =>
        list.forEach((b, j) => {
          if (i < j && area(union(a, b)) < best) [best, pair] = [area(union(a, b)), [i, j]];
        }),
      );
      greedy += best;
      list = [...list.filter((_, i) => !pair.includes(i)), union(list[pair[0]!]!, list[pair[1]!]!)];
    }
    group.run(16);
    ours += check(group, 16).surface;
  }
  expect(ours).toBeLessThan(1.02 * greedy);
});

test('identical boxes make a balanced tree; points, planes and huge boxes work', () => {
  const group = new Agglomerator(0);
  const set = (box: (i: number) => number[]) => {
    for (let i = 0; i < 16; i++) group.boxes.set(box(i), 6 * i);
    group.run(16);
    return check(group, 16).height;
  };
  expect(set(() => [0, 0, 0, 1, 1, 1])).toBe(4);
  expect(set(() => [2, 2, 2, 2, 2, 2])).toBe(4);
  expect(set((i) => [i, 0, 0, i + 1, 1, 0])).toBe(4);
  set((i) => [-3e38, i, 0, 3e38, i * i, 1]);
  set((i) => [i * 1e-40, 0, 0, i * 1e-40, 0, 0]);
});

import { describe, expect, it } from 'vitest';
import { finish } from '@glanz/scene';
import type { TreeLights } from '../../src/lights/light-bounds';
import { lightTreeSteps } from '../../src/lights/light-tree';
import { randomLights, treeNodes } from '../tree-lights';

const angle = (a: ArrayLike<number>, b: ArrayLike<number>) =>
  Math.acos(Math.min(1, Math.max(-1, a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!)));

/** The lights under each node, found by walking. */
function under(tree: { readonly nodes: ReturnType<typeof treeNodes> }, node: number): number[] {
  const { light, child } = tree.nodes[node]!;
  return light !== undefined ? [light] : [...under(tree, child!), ...under(tree, child! + 1)];
}

function check(lights: TreeLights, near: number[], distant: number[] = []): void {
  const built = finish(lightTreeSteps(lights, near, distant));
  const tree = { nodes: treeNodes(built), trails: built.trails };
  expect(under(tree, 0).sort((a, b) => a - b)).toEqual([...near, ...distant].sort((a, b) => a - b));
  expect(tree.nodes).toHaveLength(2 * (near.length + distant.length) - 1);
  for (const i of [...near, ...distant]) {
    let node = 0;
    for (let trail = tree.trails[i]!; tree.nodes[node]!.light === undefined; trail >>>= 1)
      node = tree.nodes[node]!.child! + (trail & 1);
    expect(tree.nodes[node]!.light).toBe(i);
    expect(tree.nodes[node]!.distant).toBe(distant.includes(i));
  }
  tree.nodes.forEach((node, index) => {
    const inside = under(tree, index);
    if (!inside.every((i) => near.includes(i) === !node.distant)) return;
    expect(node.energy).toBeCloseTo(
      inside.reduce((sum, i) => sum + lights.energies[i]!, 0),
      9,
    );
    // One assertion a node: a thousand lights under each other have a million corners.
    const outside = inside.filter((i) => {
      // Each corner of its box lies in the sphere, and each of its normals in the cone.
      for (let corner = 0; corner < 8 && !node.distant; corner++) {
        const p = [0, 1, 2].map((k) => lights.bounds[6 * i + k + ((corner >> k) & 1) * 3]! - node.center[k]!);
        if (!(Math.hypot(...p) <= node.radius + 1e-9)) return true;
      }
      const away = angle(node.axis, lights.axes.subarray(3 * i, 3 * i + 3)) + lights.spreads[i]!;
      return !(
        Math.min(away, Math.PI) <= Math.acos(node.cosSpread) + 1e-6 &&
        node.cosReach <= Math.cos(lights.reaches[i]!) + 1e-12
      );
    });
    expect(outside, `lights that node ${index} does not bound`).toEqual([]);
  });
}

describe('lightTreeSteps', () => {
  it.each([1, 2, 3, 17, 400])('bounds %i lights, and its trails lead to them', (count) => {
    check(randomLights(count, 5 + count), [...Array(count).keys()]);
  });

  it('hangs distant lights beside the others, and leaves out what it was not given', () => {
    const lights = randomLights(40, 9);
    check(
      lights,
      [...Array(30).keys()].filter((i) => i % 3 > 0),
      [33, 35, 39],
    );
    check(lights, [], [33, 35, 39]);
    check(lights, [7], [33]);
  });

  it('no way is longer than a trail has bits: a thousand lights in one place, or each a tenth as far as the last', () => {
    const same = randomLights(1000, 3);
    same.bounds.fill(0.5);
    check(same, [...Array(1000).keys()]);
    const series = randomLights(300, 3);
    for (let i = 0; i < 300; i++) series.bounds.fill(10 ** -i, 6 * i, 6 * i + 6);
    check(series, [...Array(300).keys()]);
  });
});

import { describe, expect, test } from 'vitest';
import { flatRows, type Item, type PartRows } from '../src/ui/part-rows';
import { itemOf, PartTree } from '../src/ui/part-tree';

/** A car with two wheels of two materials each, and a ground. */
const car = () =>
  new PartTree(
    ['Body', 'Left', 'Left', 'Right', 'Right', 'Lamp', 'Ground'],
    ['paint', 'rubber', 'chrome', 'rubber', 'chrome', 'glass', 'grey'],
    [
      { name: 'Car', from: 0, to: 6 },
      { name: 'Axle / Wheels', from: 1, to: 5 },
      { name: 'Left', from: 1, to: 3 },
      { name: 'Right', from: 3, to: 5 },
    ],
  );
const [CAR, WHEELS, LEFT, RIGHT] = [0, 1, 2, 3].map(itemOf) as [Item, Item, Item, Item];

/** The tree as text, from a row on. */
const drawn = (tree: PartRows, item?: Item): unknown[] =>
  tree
    .children(item)
    .map((child) => (tree.group(child) ? [tree.group(child)!.name, ...drawn(tree, child)] : tree.labels[child]));

describe('the tree', () => {
  test('parts in their groups; those of one node by their materials', () => {
    expect(drawn(car())).toEqual([
      ['Car', 'Body', ['Axle / Wheels', ['Left', 'rubber', 'chrome'], ['Right', 'rubber', 'chrome']], 'Lamp'],
      'Ground',
    ]);
    expect(car().names[2]).toBe('Left');
    expect(car().parts(WHEELS)).toEqual([1, 2, 3, 4]);
    expect(car().parts(6)).toEqual([6]);
    expect([1, LEFT, WHEELS, CAR, 6].map((item) => car().parent(item))).toEqual([
      LEFT,
      WHEELS,
      CAR,
      undefined,
      undefined,
    ]);
  });

  test('without groups, a list of names', () => {
    const tree = flatRows(['A', 'B', 'aB']);
    expect(drawn(tree)).toEqual(['A', 'B', 'aB']);
    tree.search('a');
    expect(drawn(tree)).toEqual(['A', 'aB']);
    expect(tree.found).toEqual([0, 2]);
    tree.search('');
    expect(drawn(tree)).toEqual(['A', 'B', 'aB']);
    expect([tree.parts(1), tree.parent(1), [...tree.opened(9)]]).toEqual([[1], undefined, []]);
  });

  test('a search finds parts, and groups with all that is in them', () => {
    const tree = car();
    tree.search('chrome');
    expect(drawn(tree)).toEqual([['Car', ['Axle / Wheels', ['Left', 'chrome'], ['Right', 'chrome']]]]);
    expect(tree.parts(CAR)).toEqual([2, 4]);
    expect([...tree.opened(100)]).toEqual([CAR, WHEELS, LEFT, RIGHT]);
    tree.search('wheels');
    expect(drawn(tree)).toEqual([
      ['Car', ['Axle / Wheels', ['Left', 'rubber', 'chrome'], ['Right', 'rubber', 'chrome']]],
    ]);
    // What has been found by its name alone stays closed.
    expect([...tree.opened(100)]).toEqual([CAR]);
    tree.search('right');
    expect(tree.found).toEqual([3, 4]);
    tree.search('nothing');
    expect(drawn(tree)).toEqual([]);
    tree.search('');
    expect(tree.found.length).toBe(7);
  });

  test('at first, level by level, as many groups are open as there is room for', () => {
    expect([...car().opened(100)]).toEqual([CAR, WHEELS, LEFT, RIGHT]);
    expect([...car().opened(9)]).toEqual([CAR, WHEELS, LEFT]);
    expect([...car().opened(5)]).toEqual([CAR]);
    expect([...car().opened(4)]).toEqual([]);
  });
});
